"""The lessons, one folder each; `workbench.lesson.catalog` finds them."""
