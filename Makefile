# The two commands of the README, for a clean clone on Debian 12. Developers use the CMake presets directly.
.PHONY: demo test setup

setup:
	@tools/check/setup.sh

demo: setup
	@tools/check/demo.sh

test: setup
	@tools/check/test.sh
