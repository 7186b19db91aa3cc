# Two commands do all the set-up: `make demo` and `make test`.

.PHONY: demo test
DEMO := out/demo.png
HOST_TESTS := $(filter-out gpu_%,$(basename $(notdir $(wildcard tests/*.rs))) \
	$(notdir $(patsubst %/main.rs,%,$(wildcard tests/*/main.rs))))

# Needs no graphics driver: without one the picture is rendered on the CPU.
demo:
	@mkdir -p $(dir $(DEMO))
	cargo run --release -- render examples/data/fire_ug.vtu --scene examples/fire.toml --output $(DEMO)
	@echo "The picture is at $(CURDIR)/$(DEMO)"

# Documentation tests first, so that the last summary is that of the large part. TETRALUX_GPU=none leaves out the tests
# that render on a graphics device, whose names begin with gpu_.
test:
	@sh scripts/test-needs.sh
	cargo test --doc --features viewer-test
	@if cargo nextest --version >/dev/null 2>&1; then \
		cargo nextest run --features viewer-test $(if $(filter none,$(TETRALUX_GPU)),-E 'not binary(/^gpu_/)'); \
	else \
		cargo test --features viewer-test --no-fail-fast --lib --bins --examples \
			$(if $(filter none,$(TETRALUX_GPU)),$(patsubst %,--test %,$(HOST_TESTS)),--tests); \
	fi
