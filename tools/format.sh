#!/usr/bin/env bash
# format.sh: formats all C++ sources by .clang-format; format.sh --check: lists those that differ
# and fails if there are any.
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
    clang-format --dry-run --Werror "${files[@]}" || {
      echo "format: 'make format' mends this"
      exit 1
    }
    echo "format: ${#files[@]} files as .clang-format has them"
    ;;
  *)
    echo "usage: tools/format.sh [--check]" >&2
    exit 2
    ;;
esac
