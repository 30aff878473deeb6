"""Run by FreeCAD at start, with and without a window. The module footpoint_freecad is on the path from here on."""
