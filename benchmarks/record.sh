#!/usr/bin/env bash
# Runs studies and records them under reports, one after the other: benchmarks/record.sh vfi-fig09 rdfc-fig06 …
# Continues a study that was interrupted. Images and records stay in noisefloor-results; OUT=DIR puts them elsewhere.
set -euo pipefail
[ $# -gt 0 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
cd "$(dirname "$0")/.."
out="${OUT:-noisefloor-results}"
cargo build --release --locked
for study in "$@"; do
  printf '\n== %s\n' "$study"
  start=$SECONDS
  # 3: a report was written, of a study in which cells failed; what failed is in its tables.
  target/release/noisefloor run "$study" --out "$out/$study" || [ $? -eq 3 ]
  target/release/noisefloor record "$out/$study" "reports/$study"
  printf '%s took %d min\n' "$study" $(((SECONDS - start) / 60))
done
