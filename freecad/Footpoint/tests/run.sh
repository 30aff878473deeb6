#!/bin/sh
# What `make test-freecad` runs: the add-on without and with a window (Xvfb). Usage: run.sh FOLDER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
out=$(mkdir -p "$1/freecad" && cd "$1/freecad" && pwd)
left_out() { echo "left out: $1"; exit 0; }
packages="freecad xvfb xauth"
if ! command -v freecadcmd >/dev/null 2>&1 || ! command -v xvfb-run >/dev/null 2>&1; then
  if [ "$(id -u)" != 0 ] || ! command -v apt-get >/dev/null 2>&1; then
    left_out "FreeCAD tests. For them run: sudo apt-get update && sudo apt-get install -y --no-install-recommends $packages"
  fi
  echo "installing with apt: $packages"
  { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $packages; } >/dev/null 2>&1 ||
    left_out "FreeCAD tests: apt cannot install $packages"
fi
python="$1/python/bin/python"
[ -x "$python" ] || python=python3
rm -rf "$out/package" "$out/home"
CARGO_TARGET_DIR="$1/cargo-lib" "$python" -m pip --disable-pip-version-check -q install --no-deps --target "$out/package" "$here/../../../python" ||
  left_out "FreeCAD tests: pip cannot build the Python package"
mkdir -p "$out/home"
export HOME="$out/home" PYTHONDONTWRITEBYTECODE=1
user=$(/usr/bin/python3 -c 'import site; print(site.getusersitepackages())')
mkdir -p "$user" && ln -sfn "$out/package/footpoint" "$user/footpoint"
freecadcmd "$here/headless.py" </dev/null >"$out/headless.txt" 2>&1 || { cat "$out/headless.txt"; exit 1; }
grep -E '^(ok|FAILED)|passed|^[a-z]+ .*[0-9]$|^face' "$out/headless.txt"
"$here/run_gui.sh" "$out" "$out/package"
