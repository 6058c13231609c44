#!/usr/bin/env bash
# The browser package: builds web/dist, and tests it in node and in headless Chromium. Called by the Makefile and tools/check/test.sh:
#   web.sh         build and tests (needs build/release, whose command the tests compare with)
#   web.sh build   only the build
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/check/quietly.sh
cd web
quietly npm ci --no-audit --no-fund
npm run --silent build
if [ "${1:-}" = build ]; then
    exit 0
fi
npm run --silent test
# One file at a time: each drives a browser. Nothing may hang for ever.
timeout 600 node --test --test-concurrency=1 --test-reporter=spec test/browser/suite.mjs test/webgpu/*.test.mjs
