"""How different two pictures are to the eye."""

import numpy

BLUR = 1.0  # pixels, standard deviation: edges may fall otherwise on another driver


def lab(rgb):
    """CIE 1976 L*a*b* of sRGB in 0..1, white D65."""
    linear = numpy.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    to_xyz = numpy.array([[0.4124564, 0.3575761, 0.1804375],
                          [0.2126729, 0.7151522, 0.0721750],
                          [0.0193339, 0.1191920, 0.9503041]])
    xyz = linear @ to_xyz.T / [0.95047, 1, 1.08883]
    root = numpy.where(xyz > 216 / 24389, numpy.cbrt(xyz), (24389 / 27 * xyz + 16) / 116)
    x, y, z = numpy.moveaxis(root, -1, 0)
    return numpy.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def blurred(picture):
    reach = int(3 * BLUR + 0.5)
    weights = numpy.exp(-0.5 * (numpy.arange(-reach, reach + 1) / BLUR) ** 2)
    weights /= weights.sum()
    for axis in (0, 1):
        padding = [(reach, reach) if i == axis else (0, 0) for i in range(picture.ndim)]
        padded = numpy.pad(picture, padding, mode="edge")
        length = picture.shape[axis]
        picture = sum(weight * padded.take(range(i, i + length), axis=axis)
                      for i, weight in enumerate(weights))
    return picture


def over(rgba, ground):
    """`rgba` in 0..255 on a ground of this grey, in 0..1."""
    colour, alpha = rgba[..., :3] / 255.0, rgba[..., 3:] / 255.0
    return colour * alpha + ground * (1 - alpha)


def difference(first, second):
    """Mean and 99th percentile of deltaE (CIE 1976), on the ground where it is larger."""
    if first.shape != second.shape:
        return numpy.inf, numpy.inf
    found = []
    for ground in (0.0, 1.0):
        apart = blurred(lab(over(first, ground))) - blurred(lab(over(second, ground)))
        delta = numpy.sqrt((apart ** 2).sum(axis=-1))
        found.append((delta.mean(), numpy.percentile(delta, 99)))
    return max(mean for mean, _ in found), max(most for _, most in found)
