#!/bin/sh
# What `make test-python` runs: the wheel built and installed into a fresh environment, its tests there. Usage: run.sh FOLDER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
env=$1/python
left_out() { echo "left out: $1"; exit 0; }
command -v python3 >/dev/null 2>&1 || left_out "Python tests: python3 is not installed (apt-get install python3-venv)"
python3 -m venv --clear "$env" >/dev/null 2>&1 || left_out "Python tests: python3 -m venv does not work (apt-get install python3-venv)"
pip="$env/bin/python -m pip --disable-pip-version-check -q"
$pip install numpy pytest tqdm "matplotlib>=3.5" setuptools wheel || left_out "Python tests: pip cannot install numpy and pytest"
# The directory of CMake's own call of cargo: what it has built is not built again.
CARGO_TARGET_DIR="$1/cargo-lib" $pip install --no-build-isolation --no-deps "$here/.."
for name in geomdl splinepy cadquery-ocp; do
  $pip install "$name" >/dev/null 2>&1 || echo "left out: the tests of its converter, pip cannot install $name"
done
cd "$1" && "$env/bin/python" -m pytest -c "$here/../pyproject.toml" --rootdir "$here/.." -p no:cacheprovider "$here"
"$env/bin/python" -m pytest -q -p no:cacheprovider --doctest-modules --pyargs footpoint
