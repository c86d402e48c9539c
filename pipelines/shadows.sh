#!/usr/bin/env bash
# Shadows with heights and soft edges. In the viewer: the truck's rear left corner, 2.4 m high, is in
# the list though the car ahead covers it in the plane (label: height), and the person behind the
# parked van fades in over some frames (diffraction). With --effects=-height,-diffraction the corner
# is gone and the person is there at once.
set -o pipefail
glint-traffic shadows \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
  | glint-sensor \
  | glint-noise
