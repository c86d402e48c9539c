#!/usr/bin/env bash
# Figure 4: a car crosses at right angles in front of a standing observer. Its side mirrors the
# radar: the strongest target stays straight ahead at zero speed while the car moves.
set -o pipefail
glint-traffic side-crossing \
  | glint-extract \
  | glint-ideal --sensors srr24-pair --sections account \
  | glint-sensor \
  | glint-noise
