#!/usr/bin/env bash
# Two posts in one cell, whose waves add with the phases of their paths: on the way towards them their
# target fades again and again, the faster the nearer, and is lost where it is down by more than it was
# above the threshold. With --effects=-coherence it is in every list.
set -o pipefail
glint-traffic two-posts \
  | glint-extract \
  | glint-ideal --sensors lrr77-coherent --sections account \
  | glint-sensor \
  | glint-noise
