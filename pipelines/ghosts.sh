#!/usr/bin/env bash
# Mirror ghosts: cars come along a concrete wall on the left, and the radar sees them in it again. In
# the viewer, coloured by path, every oncoming car gets a twin behind the wall (wall_object_wall) and,
# where the paths that go by the wall one way only merge (wall_object, object_wall), a third target
# on the wall itself. With --effects=-ghosts for glint-ideal they are gone.
set -o pipefail
glint-traffic walled-road \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
  | glint-sensor \
  | glint-noise
