# SPDX-License-Identifier: MPL-2.0
"""Light on cells: soft shadows, darker hollows, a gloss; and the glass of a tube around them. Needs numpy."""
import numpy

from .rasteriser import Camera, barycentric, rasterise, unit
from .surfaces import vertex_normals

_SHADOW_MAP_PIXELS = 1400
_SHADOW_BLUR_UM = 0.45
_HOLLOW_RADIUS_UM = 1.6
_TAPS = 14
_GLOW = numpy.array([1.35, 0.80, 0.70])


def _spiral(count):
    """Points spread evenly over the unit disc (golden-angle spiral)."""
    index = numpy.arange(count) + 0.5
    angle = index * numpy.pi * (3 - numpy.sqrt(5))
    return numpy.sqrt(index / count)[:, None] * numpy.stack([numpy.cos(angle), numpy.sin(angle)], axis=1)


class Lights:
    """Directions toward the lights and the eye's background; all relative to the camera, so every scene looks alike."""

    def __init__(self, camera):
        self.key = unit(-0.45 * camera.right + 0.80 * camera.up - 0.62 * camera.forward)
        self.fill = unit(0.75 * camera.right + 0.10 * camera.up - 0.60 * camera.forward)
        self.above = camera.up


def _shadow(points, triangles, seen, direction):
    """Share of the key light, 0 to 1, that reaches each of the seen points."""
    centre = 0.5 * (points.min(axis=0) + points.max(axis=0))
    radius = numpy.linalg.norm(points - centre, axis=1).max()
    across = unit(numpy.cross(direction, [0.31, 0.17, 0.93]))
    scale = 0.5 * _SHADOW_MAP_PIXELS / radius
    sun = Camera(centre + 2 * radius * direction, centre, across, scale, _SHADOW_MAP_PIXELS, _SHADOW_MAP_PIXELS,
                 perspective=False)
    first_lit = rasterise(sun.project(points), triangles, sun.width, sun.height).depth
    place = sun.project(seen)
    lit = numpy.zeros(len(seen))
    for tap in _spiral(_TAPS) * _SHADOW_BLUR_UM * scale:
        column = numpy.clip((place[:, 0] + tap[0]).astype(int), 0, sun.width - 1)
        row = numpy.clip((place[:, 1] + tap[1]).astype(int), 0, sun.height - 1)
        # A surface does not shade itself within the blur, where the map is as steep as the surface.
        lit += place[:, 2] < first_lit[row, column] + 0.35
    return lit / _TAPS


def _hollows(depth, camera):
    """Share of open space, 0 to 1, in front of each pixel: dark where nearer surfaces crowd around it."""
    near = numpy.where(numpy.isfinite(depth), depth, 1e9)
    blocked = numpy.zeros(depth.shape)
    reach = _HOLLOW_RADIUS_UM * camera.scale
    for tap in numpy.rint(_spiral(_TAPS) * reach).astype(int):
        above = near - numpy.roll(near, tuple(tap), axis=(0, 1))
        blocked += numpy.clip(above / 0.5, 0, 1) * numpy.clip(2.2 - above / 2.0, 0, 1)
    return 1 - blocked / _TAPS


def shade(points, triangles, colours, camera):
    """(rgba, depth): the surfaces as the camera sees them; rgba (height, width, 4) with 0 where nothing is.

    `colours`: (triangles, 3), 0 to 1.
    """
    screen = camera.project(points)
    visible = rasterise(screen, triangles, camera.width, camera.height)
    rows, columns = numpy.nonzero(visible.triangle >= 0)
    which = visible.triangle[rows, columns]
    corners = triangles[which]
    weights = barycentric(screen[corners], columns + 0.5, rows + 0.5)[:, :, None]
    seen = numpy.sum(weights * points[corners], axis=1)
    normals = numpy.sum(weights * vertex_normals(points, triangles)[corners], axis=1)
    normals /= numpy.linalg.norm(normals, axis=1)[:, None]
    open_space = _hollows(visible.depth, camera)[rows, columns]

    lights = Lights(camera)
    to_eye = camera.eye - seen
    to_eye /= numpy.linalg.norm(to_eye, axis=1)[:, None]
    shadow = _shadow(points, triangles, seen, lights.key)
    # Light wraps a little around the edge, as it does in a body that lets some of it through.
    key = numpy.clip((normals @ lights.key + 0.25) / 1.25, 0, None) * (0.25 + 0.75 * shadow)
    fill = numpy.clip(normals @ lights.fill, 0, None)
    sky = 0.5 + 0.5 * (normals @ lights.above)
    half = to_eye + lights.key
    half /= numpy.linalg.norm(half, axis=1)[:, None]
    gloss = numpy.clip(numpy.sum(normals * half, axis=1), 0, 1) ** 26 * (0.10 + 0.90 * shadow)
    rim = (1 - numpy.clip(numpy.sum(normals * to_eye, axis=1), 0, 1)) ** 3

    light = 0.84 * key + 0.20 * fill + (0.26 + 0.24 * sky) * open_space
    base = colours[which]
    # What light the body scatters inside: it keeps shadows warm instead of grey.
    glow = 0.20 * base * _GLOW * (0.45 + 0.55 * open_space[:, None])
    shaded = (base * light[:, None] * (0.62 + 0.38 * open_space[:, None]) + glow + 0.17 * gloss[:, None]
              + (0.20 * rim * open_space)[:, None] * (0.65 * base + 0.35))
    rgba = numpy.zeros((camera.height, camera.width, 4), dtype=numpy.float32)
    # A soft shoulder: bright places keep their colour.
    rgba[rows, columns, :3] = numpy.where(shaded < 0.6, shaded, 1 - 0.4 * numpy.exp(-(shaded - 0.6) / 0.4))
    rgba[rows, columns, 3] = 1
    return rgba, visible.depth


def averaged(image, factor):
    """The image with `factor` times fewer pixels each way, each the mean of the ones it covers."""
    height, width = image.shape[0] // factor, image.shape[1] // factor
    return image.reshape((height, factor, width, factor) + image.shape[2:]).mean(axis=(1, 3))


def glass_tube(camera, axis_start, axis_end, radius):
    """[(depth, alpha, gloss)] of the far and the near wall of a thin glass tube; alpha 0 where the tube is not."""
    direction = unit(axis_end - axis_start)
    length = numpy.linalg.norm(axis_end - axis_start)
    rays = camera.rays()
    offset = camera.eye - axis_start
    rays_across = rays - (rays @ direction)[..., None] * direction
    offset_across = offset - (offset @ direction) * direction
    a = numpy.sum(rays_across ** 2, axis=2)
    b = rays_across @ offset_across
    discriminant = b ** 2 - a * (offset_across @ offset_across - radius ** 2)
    root = numpy.sqrt(numpy.maximum(discriminant, 0))
    half = Lights(camera).key - camera.forward
    half = unit(half - (half @ direction) * direction)
    walls = []
    for sign in (1, -1):
        depth = (-b + sign * root) / a
        place = offset + depth[..., None] * rays
        along = place @ direction
        normal = (place - along[..., None] * direction) / radius
        steep = 1 - numpy.abs(numpy.sum(normal * rays, axis=2)) / numpy.linalg.norm(rays, axis=2)
        inside = (discriminant > 0) & (along >= 0) & (along <= length)
        alpha = numpy.where(inside, 0.035 + 0.50 * steep ** 4, 0)
        gloss = numpy.where(inside, numpy.clip(numpy.sum(normal * half, axis=2), 0, 1) ** 220, 0)
        walls.append((depth, alpha, gloss))
    return walls


def laid_over(image, colour, alpha):
    """`colour` over `image` where `alpha` says so."""
    return image * (1 - alpha[..., None]) + numpy.asarray(colour) * alpha[..., None]
