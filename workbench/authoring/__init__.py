"""For people who write lessons: a folder to begin with, the promises a lesson keeps, and reloading
while it is edited.
"""
