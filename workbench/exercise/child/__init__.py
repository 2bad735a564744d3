"""What runs in a student's process: all of ours that is in its sight, and nothing that knows an
answer.
"""
