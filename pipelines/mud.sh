#!/usr/bin/env bash
# A stage of your own, in any language: mud on the bumper blinds a sector of both sensors.
set -o pipefail
here=$(dirname "$0")
glint-traffic intersection \
  | glint-extract \
  | glint-ideal --sensors srr24-pair --account \
  | python3 "$here/mud.py" -0.2 0.1 \
  | glint-sensor \
  | glint-noise
