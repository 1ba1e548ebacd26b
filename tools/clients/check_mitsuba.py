"""In the primary bow red lies outside blue, in the secondary inside; Alexander's band is dark."""

import math
import sys

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
image = np.array(mi.Bitmap(sys.argv[1]))[..., :3].astype(float)
height, width, _ = image.shape
elevation, fov = math.radians(20.0), math.radians(120.0)
x = (np.arange(width) + 0.5 - width / 2) / (width / 2) * math.tan(fov / 2)
y = (height / 2 - np.arange(height) - 0.5) / (width / 2) * math.tan(fov / 2)
right, up = np.meshgrid(x, y)
norm = np.sqrt(1 + right**2 + up**2)
angle = np.degrees(np.arccos((math.cos(elevation) - up * math.sin(elevation)) / norm))
edges = np.arange(36.0, 58.0, 0.5)
middle = 0.5 * (edges[1:] + edges[:-1])
profile = np.array([[image[..., c][(angle >= a) & (angle < b)].mean() for c in range(3)]
                    for a, b in zip(edges[:-1], edges[1:])])


def centre(channel, low, high):
    inside = (middle > low) & (middle < high)
    values = profile[inside, channel]
    weight = np.clip(values - 0.5 * values.max(), 0, None)
    return float((middle[inside] * weight).sum() / weight.sum())


for name, low, high, sign in (("primary", 38.5, 44.0, 1), ("secondary", 49.0, 56.5, -1)):
    red, green, blue = (centre(channel, low, high) for channel in range(3))
    print(f"{name}: red {red:.2f}, green {green:.2f}, blue {blue:.2f} degree from the antisolar point")
    assert sign * (red - green) > 0.1 and sign * (green - blue) > 0.1, name
luminance = profile @ [0.2126, 0.7152, 0.0722]
band = luminance[(middle > 44.5) & (middle < 48.5)].mean()
inner = luminance[(middle > 36) & (middle < 39)].mean()
print(f"Alexander's band / inside of the bow: {band / inner:.2f}")
assert band < inner
