"""Preferences, files beside the add-on, and the library."""

import os

import FreeCAD

ADDON = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def resource(*names):
    """A file or folder under Resources."""
    return os.path.join(ADDON, "Resources", *names)


def preferences():
    """The parameters of the preferences page."""
    return FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Footpoint")


def tolerance():
    """Length in mm; 0: 1e-7 of the size of the shape."""
    return max(0.0, preferences().GetFloat("Tolerance", 0.0))


def library():
    """The Python package footpoint, with the library that the preferences name."""
    path = preferences().GetString("LibraryPath", "")
    if path:
        os.environ.setdefault("FOOTPOINT_LIBRARY", path)
    try:
        import footpoint
    except ImportError as error:
        raise ImportError(f"{error}. Install the Python package footpoint for FreeCAD's Python (pip install ./python in the repository of "
                          "footpoint), or name the library file in the preferences") from error
    return footpoint
