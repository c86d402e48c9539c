"""The evaluation of KITTI as toolboxes run it on boxes that are turned about the vertical: overlap in single precision, and
average precision at 40 recalls.

Overlap is computed as they do it, with its faults: sides cross where the ends of each lie on two sides of the other, by the
signs of areas. Where two sides lie on one line these signs are those of rounding, and a crossing is anywhere; where they are
parallel to the last bit it is a division by zero.
"""
import numpy

RECALLS = 40
LEAST_OVERLAP = {"Car": 0.7, "Pedestrian": 0.5, "Cyclist": 0.5}


def outlines(boxes):
    """Corners of boxes, from columns x, y, length, width, angle: shape (boxes, 4, 2)."""
    x, y, length, width, angle = numpy.asarray(boxes, numpy.float32).reshape(-1, 5).T
    ahead, left = (numpy.array(signs, numpy.float32) / 2 for signs in ((-1, -1, 1, 1), (-1, 1, 1, -1)))
    c, s = numpy.cos(angle), numpy.sin(angle)
    along, across = numpy.outer(length, ahead), numpy.outer(width, left)
    return numpy.stack([c[:, None] * along + s[:, None] * across + x[:, None], c[:, None] * across - s[:, None] * along + y[:, None]], -1)


def crossed(one, other):
    """Twice the signed area that vectors span."""
    return one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]


def crossings(ours, theirs):
    """Where sides cross, and whether they do: shapes (n, m, 16, 2) and (n, m, 16)."""
    a, b = ours[:, None, :, None], numpy.roll(ours, -1, 1)[:, None, :, None]
    c, d = theirs[None, :, None], numpy.roll(theirs, -1, 1)[None, :, None]
    a, b, c, d = numpy.broadcast_arrays(a, b, c, d)
    apart = (crossed(c - a, d - a) > 0) != (crossed(c - b, d - b) > 0)
    apart &= (crossed(c - a, b - a) > 0) != (crossed(d - a, b - a) > 0)
    slope = crossed(d - c, b - a)
    if (apart & (slope == 0)).any():
        raise ZeroDivisionError("sides that are parallel cross")
    first, second = crossed(a, b), crossed(c, d)
    with numpy.errstate(all="ignore"):
        points = ((d - c) * first[..., None] - (b - a) * second[..., None]) / slope[..., None]
    return points.reshape(*points.shape[:2], 16, 2), apart.reshape(*apart.shape[:2], 16)


def inside(points, outline):
    """Which points lie in which outlines, by the products with two of the sides: shapes (n, 4, 2) and (m, 4, 2) give (n, m, 4)."""
    corner = outline[None, :, None, 0]
    found = True
    for side in (outline[None, :, None, 1] - corner, outline[None, :, None, 3] - corner):
        along = ((points[:, None] - corner) * side).sum(-1)
        found = found & (along >= 0) & (along <= (side * side).sum(-1))
    return found


def shared_areas(boxes, others):
    """The area that each box has in common with each other one."""
    ours, theirs = outlines(boxes), outlines(others)
    n, m = len(ours), len(theirs)
    points, are_corners = crossings(ours, theirs)
    points = numpy.concatenate([points, numpy.broadcast_to(ours[:, None], (n, m, 4, 2)), numpy.broadcast_to(theirs[None], (n, m, 4, 2))], 2)
    are_corners = numpy.concatenate([are_corners, inside(ours, theirs), inside(theirs, ours).transpose(1, 0, 2)], 2)
    points = numpy.where(are_corners[..., None], points, 0)
    count = are_corners.sum(-1)
    spread = points - (points.sum(2) / numpy.maximum(count, 1)[..., None])[:, :, None]
    order = numpy.argsort(numpy.where(are_corners, numpy.arctan2(spread[..., 1], spread[..., 0]), numpy.inf), -1)
    ring = numpy.take_along_axis(spread, order[..., None], 2)
    ring = numpy.where((numpy.arange(24) < count[..., None])[..., None], ring, ring[:, :, :1])
    return numpy.abs(crossed(ring, numpy.roll(ring, -1, 2)).sum(-1)) / 2 * (count > 2)


def overlaps(boxes, others):
    """Of volumes, for boxes x, y, bottom, length, width, height, angle: shared by united."""
    boxes, others = (numpy.asarray(one, float).reshape(-1, 7) for one in (boxes, others))
    area = shared_areas(boxes[:, [0, 1, 3, 4, 6]], others[:, [0, 1, 3, 4, 6]])
    top = numpy.minimum((boxes[:, 2] + boxes[:, 5])[:, None], (others[:, 2] + others[:, 5])[None])
    shared = area * numpy.maximum(top - numpy.maximum(boxes[:, None, 2], others[None, :, 2]), 0)
    united = boxes[:, 3:6].prod(1)[:, None] + others[:, 3:6].prod(1)[None] - shared
    return shared / united


def matched(scan, least_score, least_overlap):
    """Scores of the predictions that are right, and how many are wrong. Each truth takes the free prediction that overlaps it most."""
    table, scores, counts = scan
    free, right = scores >= least_score, []
    wrong = free.sum()
    for i, is_counted in enumerate(counts):
        fit = numpy.where(free & (table[:, i] > least_overlap), table[:, i], -1) if len(scores) else numpy.array([-1])
        best = fit.argmax()
        if fit[best] < 0:
            continue
        free[best], wrong = False, wrong - 1
        if is_counted:
            right.append(scores[best])
    return right, wrong


def average_precision(scans, least_overlap):
    """AP at 40 recalls in percent. A scan: overlaps of its predictions (rows) with its truth, scores, and which truth is counted;
    the rest is ignored."""
    whole = sum(int(numpy.sum(counts)) for _, _, counts in scans)
    scores = sorted((one for scan in scans for one in matched(scan, -numpy.inf, least_overlap)[0]), reverse=True)
    limits, recall = [], 0.0
    for i, score in enumerate(scores):
        now, after = (i + 1) / whole, (i + 2) / whole
        if i == len(scores) - 1 or after - recall >= recall - now:
            limits.append(score)
            recall += 1 / RECALLS
    precision = numpy.zeros(RECALLS + 1)
    for i, limit in enumerate(limits):
        found = [matched(scan, limit, least_overlap) for scan in scans]
        right, wrong = sum(len(one) for one, _ in found), sum(one for _, one in found)
        precision[i] = right / (right + wrong)
    return 100 * numpy.maximum.accumulate(precision[::-1])[::-1][1:].mean()
