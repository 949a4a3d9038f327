# The most common tasks. Each target first installs missing packages and builds what it needs.
.PHONY: build test test-long demo view package bench bench-gpu bench-page format lint fuzz configured

build: configured
	@cmake --build --preset release

test: build
	@ctest --preset release

test-long: build
	@ctest --preset release-long

demo: configured
	@cmake --build --preset release --target wheatstone_cli
	@scripts/demo

view: configured
	@cmake --build --preset release --target wheatstone_cli wheatstone_view
	@scripts/demo
	@build/release/bin/wheatstone view demo/*/painting.wst

# Configured again, because the environment may name the maintainer (packaging/maintainer.cmake).
package: configured
	@cmake build/release
	@cmake --build --preset release
	@rm -f build/release/packages/*.deb
	@cd build/release && cpack --config CPackConfig.cmake
	@ls build/release/packages/*.deb

bench: build
	@scripts/bench

bench-gpu: configured
	@cmake --build --preset release --target bench_gpu bench_gpu_painting
	@build/release/bin/bench_gpu
	@build/release/bin/bench_gpu_painting

bench-page: configured
	@cmake --build --preset release --target wheatstone_cli
	@page/test/bench.sh build/release/bin/wheatstone build/release/bench-page

format:
	@scripts/install-deps lint
	@scripts/format

lint: configured
	@scripts/install-deps lint
	@scripts/lint

fuzz:
	@scripts/install-deps fuzz
	@scripts/fuzz

configured:
	@scripts/install-deps
	@test -f build/release/build.ninja || cmake --preset release
