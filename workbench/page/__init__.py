"""The one page that people see, in three homes: live, published, and in a notebook.

`static` has its HTML, CSS and JavaScript; the modules make the plain data that feed it, the same in
every home. Nothing here knows where the page is shown, or how a scene is drawn.
"""
