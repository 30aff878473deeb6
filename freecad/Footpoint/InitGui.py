"""The workbench: tool bar, menu, preferences page."""

import FreeCADGui as Gui


class FootpointWorkbench(Gui.Workbench):
    """Points on faces and edges, with a proof."""

    def __init__(self):
        from footpoint_freecad import settings

        self.__class__.MenuText = "Footpoint"
        self.__class__.ToolTip = "Parameters and nearest points with a proof, deviation maps"
        self.__class__.Icon = settings.resource("icons", "Footpoint.svg")
        Gui.addLanguagePath(settings.resource("translations"))
        Gui.addPreferencePage(settings.resource("ui", "preferences.ui"), "Footpoint")
        Gui.addIconPath(settings.resource("icons"))

    def Initialize(self):
        from footpoint_freecad import commands

        names = commands.register()
        self.appendToolbar("Footpoint", names)
        self.appendMenu("Footpoint", names)

    def GetClassName(self):
        return "Gui::PythonWorkbench"


Gui.addWorkbench(FootpointWorkbench())
