#!/bin/sh
# Starts FreeCAD in a window under Xvfb with the add-on and runs gui.py there. Usage: run_gui.sh OUT PACKAGE [POINTS]; PACKAGE is the folder
# that pip installed the package footpoint to (FreeCAD's window does not look at PYTHONPATH, but at the user's packages).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
out=$1
mkdir -p "$out/home/.local/share/FreeCAD/Mod"
ln -sfn "$(dirname "$here")" "$out/home/.local/share/FreeCAD/Mod/Footpoint"
export HOME="$out/home"
user=$(/usr/bin/python3 -c 'import site; print(site.getusersitepackages())')
mkdir -p "$user"
ln -sfn "$(cd "$2" && pwd)/footpoint" "$user/footpoint"
export FOOTPOINT_OUT="$out" FOOTPOINT_POINTS="${3:-20000}" QTWEBENGINE_DISABLE_SANDBOX=1 LIBGL_ALWAYS_SOFTWARE=1
timeout 300 xvfb-run -a -s "-screen 0 1280x800x24 +extension GLX" freecad "$here/gui.py" >"$out/freecad.log" 2>&1 || true
cat "$out/gui.txt"
tail -n 1 "$out/gui.txt" | grep -q '^done$' && ! grep -q '^WRONG' "$out/gui.txt"
