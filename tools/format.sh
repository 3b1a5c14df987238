#!/usr/bin/env bash
# format.sh: formats all C++ sources by .clang-format; format.sh --check [FILE...]: lists those that
# differ, of all or of these, and fails if there are any.
set -euo pipefail
cd "$(dirname "$0")/.."

folders=()
for folder in include src apps tests benchmarks examples python; do
  if [ -d "$folder" ]; then folders+=("$folder"); fi
done
mapfile -t files < <(find "${folders[@]}" \( -name node_modules -o -name .venv \) -prune -o \
  \( -name '*.cpp' -o -name '*.hpp' \) -print | sort)

case ${1:-} in
  "") clang-format -i "${files[@]}" ;;
  --check)
    if [ $# -gt 1 ]; then files=("${@:2}"); fi
    clang-format --dry-run --Werror "${files[@]}" || {
      echo "format: 'make format' mends this"
      exit 1
    }
    echo "format: ${#files[@]} files as .clang-format has them"
    ;;
  *)
    echo "usage: tools/format.sh [--check [FILE...]]" >&2
    exit 2
    ;;
esac
