# Two commands do all the set-up: `make demo` and `make test`.

.PHONY: demo test
DEMO := out/demo.png

# Needs no graphics driver: without one the picture is rendered on the CPU.
demo:
	@mkdir -p $(dir $(DEMO))
	cargo run --release -- render examples/data/fire_ug.vtu --scene examples/fire.toml --output $(DEMO)
	@echo "The picture is at $(CURDIR)/$(DEMO)"

# Documentation tests first, so that the last summary is that of the large part.
test:
	@sh scripts/vulkan-driver.sh
	cargo test --doc
	@if cargo nextest --version >/dev/null 2>&1; then \
		cargo nextest run; \
	else \
		cargo test --lib --bins --tests --examples; \
	fi
