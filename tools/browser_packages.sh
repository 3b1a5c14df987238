#!/usr/bin/env bash
# Installs the node packages that tests/browser/package.json names, unless they are there already.
set -euo pipefail
cd "$(dirname "$0")/../tests/browser"

stamp=node_modules/.installed-for
wanted=$(cat package.json package-lock.json 2>/dev/null | sha256sum)
if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$wanted" ]; then
  echo "node packages are there"
  exit 0
fi
# The browser is the system's own: no package may download one.
export PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD=1
npm ci --ignore-scripts --no-audit --no-fund
echo "$wanted" >"$stamp"
