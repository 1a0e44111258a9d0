"""What Open Image Denoise makes of a picture with the layers albedo and normal.

    pip install numpy OpenEXR pyoidn
    licht render cornell --spp 4 --aov albedo,normal -o noisy.exr
    python3 samples/oidn/denoise.py noisy.exr clean.exr
"""
import sys

import numpy
import OpenEXR
import pyoidn

source, target = sys.argv[1:]
with OpenEXR.File(source, separate_channels=True) as picture:
    header, channels = picture.header(), picture.channels()
    colour, albedo, normal = (
        numpy.stack([channels[name].pixels for name in names], axis=-1)
        for names in (("R", "G", "B"), ("albedo.R", "albedo.G", "albedo.B"), ("N.X", "N.Y", "N.Z"))
    )
    clean = pyoidn.denoise(colour, albedo, normal, hdr=True)
    for c, name in enumerate("RGB"):
        channels[name].pixels = numpy.ascontiguousarray(clean[..., c])
    # `licht compare` then knows that pixels depend on each other; nothing is known of their error.
    header.update({"licht.denoise": "oidn", "licht.relativeError": "unknown"})
    OpenEXR.File(header, channels).write(target)
