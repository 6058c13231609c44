# The commands of the README, for a clean clone on Debian 12. Developers use the CMake presets directly.
.PHONY: demo test web web-serve

demo:
	@tools/check/setup.sh demo
	@tools/check/demo.sh

# FAST=1: only the quick checks, gcc and its tests.
test:
	@tools/check/setup.sh test
	@FAST=$(FAST) tools/check/test.sh

# The browser package and the page, into web/dist.
web:
	@tools/check/setup.sh web
	@tools/check/web.sh build

# The same, served to this machine alone. PORT=8080 by default.
web-serve: web
	@node web/serve.mjs --port $(or $(PORT),8080)
