#!/usr/bin/env bash
# Rates that fold: cars that come closer by 55 m/s are listed as if they went away by 43 m/s, 98 m/s more,
# as the radar tells range rates apart only within 49 m/s; their labels keep the true ones. Without
# interference and weather, which have pipelines of their own.
set -o pipefail
glint-traffic wet-road \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
      --effects=-interference,-rain,-fog \
  | glint-sensor \
  | glint-noise
