#!/usr/bin/env bash
# Wheels and limbs. In the viewer, coloured by path, the car that turns in and the cyclist have targets
# on their wheels that are slower or faster than they are, up to twice as fast over ground, and the
# person now and then has an arm or a leg beside. With --effects=-wheels,-limbs for glint-ideal every
# object has the rates of its body alone.
set -o pipefail
glint-traffic wheels-and-limbs \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
  | glint-sensor \
  | glint-noise
