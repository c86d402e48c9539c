#!/usr/bin/env bash
# The road as a mirror. In the viewer, the amplitude of the post falls and rises as the ego comes
# nearer: it fades at 64, 43, 32 m and so on, where what comes by way of the road cancels what comes
# straight, and is lost there, while the corners of the car beside it, which are extended, keep
# theirs. With --effects=-two_ray for glint-ideal the post has no such gaps.
set -o pipefail
glint-traffic road-mirror \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
  | glint-sensor \
  | glint-noise
