"""Render the bow of phase.csv with Mitsuba 3:  python scene.py [--out bow.exr] [--spp 64]"""

import argparse
import os

import mitsuba as mi

parser = argparse.ArgumentParser()
parser.add_argument("--out", default="bow.exr")
parser.add_argument("--spp", type=int, default=64)
parser.add_argument("--width", type=int, default=480)
parser.add_argument("--height", type=int, default=270)
parser.add_argument("--variant", default="llvm_ad_spectral")
parser.add_argument("--exposure", type=float, default=4.0, help="factor of the PNG")
parser.add_argument("--sun-elevation", type=float, default=20.0, help="degree")
args = parser.parse_args()

mi.set_variant(args.variant)
here = os.path.dirname(os.path.abspath(__file__))
import sys

sys.path.insert(0, here)
import gonio_phase  # noqa: E402,F401  registers the plugin

import math

elevation = math.radians(args.sun_elevation)
# Sunlight travels along +x and down; the antisolar point is where it goes.
light = [math.cos(elevation), 0.0, -math.sin(elevation)]
rain = mi.load_dict({
    "type": "homogeneous",
    "albedo": 1.0,
    "sigma_t": 0.002,
    "phase": {"type": "gonio", "filename": os.path.join(here, "phase.csv")},
})
scene = mi.load_dict({
    "type": "scene",
    "integrator": {"type": "volpath", "max_depth": 2, "rr_depth": 100},
    "air": {"type": "sphere", "radius": 100.0, "bsdf": {"type": "null"}, "interior": rain},
    "sun": {
        "type": "directional",
        "direction": light,
        "irradiance": {"type": "spectrum", "value": 10.0},
    },
    "sensor": {
        "type": "perspective",
        "fov": 120.0,
        "to_world": mi.ScalarTransform4f().look_at(
            origin=[0, 0, 0], target=[1, 0, 0.0], up=[0, 0, 1]
        ),
        "medium": rain,
        "film": {
            "type": "hdrfilm", "width": args.width, "height": args.height,
            "rfilter": {"type": "box"}, "pixel_format": "rgb",
        },
        "sampler": {"type": "independent", "sample_count": args.spp},
    },
})
image = mi.render(scene, spp=args.spp)
mi.util.write_bitmap(args.out, image)
if args.out.endswith(".exr"):
    mi.util.write_bitmap(args.out[:-4] + ".png", args.exposure * image)
