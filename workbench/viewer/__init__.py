"""The live page: the only part of the workbench, beside publishing, that knows viser."""
