# The two commands of the README, for a clean clone on Debian 12. Developers use the CMake presets directly.
.PHONY: demo test

demo:
	@tools/check/setup.sh demo
	@tools/check/demo.sh

# FAST=1: only the quick checks, gcc and its tests.
test:
	@tools/check/setup.sh test
	@FAST=$(FAST) tools/check/test.sh
