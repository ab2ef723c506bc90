# SPDX-License-Identifier: MPL-2.0
"""A camera and a z-buffer: which triangle is seen in each pixel. Needs numpy."""
import numpy

_FRAGMENTS_AT_A_TIME = 1 << 20


def unit(vector):
    vector = numpy.asarray(vector, dtype=float)
    return vector / numpy.linalg.norm(vector)


class Camera:
    """Looks from `eye` at `target`; a length of 1 um in the target's plane is `scale` pixels. Pixel rows run down.

    A parallel camera (perspective=False) has the same scale at every depth.
    """

    def __init__(self, eye, target, up, scale, width, height, perspective=True):
        self.eye = numpy.asarray(eye, dtype=float)
        self.forward = unit(numpy.asarray(target, dtype=float) - self.eye)
        self.right = unit(numpy.cross(self.forward, up))
        self.up = numpy.cross(self.right, self.forward)
        self.distance = float(numpy.linalg.norm(numpy.asarray(target, dtype=float) - self.eye))
        self.scale = scale
        self.width = width
        self.height = height
        self.perspective = perspective

    def project(self, points):
        """(n, 3): pixel column, pixel row, depth (um along the view)."""
        away = numpy.asarray(points, dtype=float) - self.eye
        depth = away @ self.forward
        scale = self.scale * self.distance / depth if self.perspective else self.scale
        return numpy.stack([0.5 * self.width + scale * (away @ self.right),
                            0.5 * self.height - scale * (away @ self.up), depth], axis=-1)

    def enlarged(self, factor):
        """The same view with `factor` times the pixels each way."""
        return Camera(self.eye, self.eye + self.distance * self.forward, self.up, self.scale * factor,
                      self.width * factor, self.height * factor, self.perspective)

    def rays(self):
        """(height, width, 3): direction through the middle of each pixel, scaled to advance 1 um in depth."""
        column = (numpy.arange(self.width) + 0.5 - 0.5 * self.width) / (self.scale * self.distance)
        row = (0.5 * self.height - numpy.arange(self.height) - 0.5) / (self.scale * self.distance)
        return self.forward + column[None, :, None] * self.right + row[:, None, None] * self.up


class Visible:
    """What each pixel sees: `depth` (height, width), infinite for nothing, and `triangle`, -1 for nothing."""

    def __init__(self, depth, triangle):
        self.depth = depth
        self.triangle = triangle


def _edge(a, b, x, y):
    """Twice the signed area of the triangle a, b, (x, y)."""
    return (b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (b[:, 1] - a[:, 1]) * (x - a[:, 0])


def barycentric(corners, x, y):
    """Weights (n, 3) of the corners (n, 3, 2 or more) of each triangle at the point (x, y)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    weights = numpy.stack([_edge(b, c, x, y), _edge(c, a, x, y), _edge(a, b, x, y)], axis=1)
    return weights / weights.sum(axis=1)[:, None]


def _chunks(counts):
    """Ranges of triangles of about _FRAGMENTS_AT_A_TIME fragments each."""
    total = numpy.cumsum(counts)
    cuts = numpy.searchsorted(total, numpy.arange(_FRAGMENTS_AT_A_TIME, total[-1] if len(total) else 0,
                                                  _FRAGMENTS_AT_A_TIME))
    cuts = numpy.unique(numpy.concatenate([[0], cuts, [len(counts)]]))
    return zip(cuts[:-1], cuts[1:])


def rasterise(screen, triangles, width, height):
    """The nearest front-facing triangle in each pixel. `screen`: (n, 3) pixel column, row, depth of the points."""
    corners = screen[triangles]
    # Pixel rows run down, so a triangle that is counter-clockwise to the eye has a negative area.
    facing = _edge(corners[:, 0], corners[:, 1], corners[:, 2, 0], corners[:, 2, 1]) < 0
    low = numpy.clip(numpy.ceil(corners[:, :, :2].min(axis=1) - 0.5), 0, [width, height]).astype(numpy.int64)
    high = numpy.clip(numpy.floor(corners[:, :, :2].max(axis=1) - 0.5) + 1, 0, [width, height]).astype(numpy.int64)
    spans = numpy.maximum(high - low, 0)
    seen = numpy.flatnonzero(facing & (spans.prod(axis=1) > 0))
    corners, low, spans = corners[seen], low[seen], spans[seen]
    counts = spans.prod(axis=1)
    depth = numpy.full(width * height, numpy.inf)
    nearest = numpy.full(width * height, -1, dtype=numpy.int64)
    for begin, end in _chunks(counts):
        own = numpy.repeat(numpy.arange(begin, end), counts[begin:end])
        place = numpy.arange(len(own)) - numpy.repeat(numpy.cumsum(counts[begin:end]) - counts[begin:end],
                                                      counts[begin:end])
        column = low[own, 0] + place % spans[own, 0]
        row = low[own, 1] + place // spans[own, 0]
        weights = barycentric(corners[own], column + 0.5, row + 0.5)
        fragment_depth = numpy.sum(weights * corners[own, :, 2], axis=1)
        pixel = row * width + column
        kept = numpy.flatnonzero((weights >= 0).all(axis=1) & (fragment_depth < depth[pixel]))
        # Farthest first: of several fragments written to one pixel the last, the nearest, stays.
        kept = kept[numpy.argsort(-fragment_depth[kept], kind="stable")]
        depth[pixel[kept]] = fragment_depth[kept]
        nearest[pixel[kept]] = seen[own[kept]]
    return Visible(depth.reshape(height, width), nearest.reshape(height, width))
