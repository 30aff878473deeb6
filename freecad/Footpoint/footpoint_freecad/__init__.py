"""footpoint for FreeCAD. For macros: `footpoint_freecad.parameters`, drop-ins for Surface.parameter and Curve.parameter.

No module but `commands` needs a window.
"""
