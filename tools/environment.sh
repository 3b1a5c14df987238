# Sourced by scripts that need Python packages from PyPI in an environment of their own: by uv, which
# installs them in a tenth of pip's time, for it fetches side by side and links what it has unpacked before.

# make_environment FOLDER: an empty environment with uv in it, of ${PYTHON:-python3}.
make_environment() {
  rm -rf "$1"
  "${PYTHON:-python3}" -m venv "$1"
  "$1/bin/python" -m pip --disable-pip-version-check install -q uv==0.13.9
}

# install_into FOLDER PACKAGE...
install_into() { "$1/bin/uv" pip install -q --python "$1/bin/python" "${@:2}"; }
