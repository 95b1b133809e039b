# Recipes; `just --list` shows them.

# All tests
test:
    cargo test --release --workspace

# Tests that take long or print measurements
extra:
    cargo test --release --workspace -- --ignored --nocapture

# Everything that must pass before a change is offered
ci:
    .ci/run

# Format the sources
fmt:
    cargo fmt --all
    rustfmt --edition 2024 crates/railcrack/src/fatigue/laws/*.rs

# Lints, on everything that is compiled
lint:
    cargo clippy --release --workspace --all-targets -- -D warnings

# Pages of the library
doc:
    RUSTDOCFLAGS="-D warnings" cargo doc --release --no-deps --workspace

# Times of body, passage and growth step, and of the plastic state
bench:
    cargo bench --bench chain --bench shakedown

# A release in target/dist, each part tried where nothing else is
dist:
    tools/dist.sh

# Compute a case
run case="cases/reference.toml":
    cargo run --release -- run {{case}}

# The engine of pages, the explorer and the book as a site, made and checked
web:
    .ci/run web
