#!/usr/bin/env bash
# An intersection with cars, a truck, a bus, two-wheelers and pedestrians, seen by the paper's pair
# of sensors.
set -o pipefail
glint-traffic intersection \
  | glint-extract \
  | glint-ideal --sensors srr24-pair --sections account \
  | glint-sensor \
  | glint-noise
