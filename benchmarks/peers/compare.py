#!/usr/bin/env python3
"""Times other programs' non-local means beside the engine here, in one run on one thread.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install opencv-python-headless scikit-image
    /tmp/peers/bin/python benchmarks/peers/compare.py [SIZE]

Window 21x21, patch 7x7, three channels, minimum of five runs. The programs do not compute the same thing: OpenCV works on
8-bit values with a table of weights, scikit-image's fast mode uses integral images and no variances. What is compared is
the time for an image of the same size with the same window and patch.
"""

import pathlib
import subprocess
import sys
import time

import cv2
import numpy
import skimage
from skimage.restoration import denoise_nl_means


def best(run):
    """Least seconds of five runs."""
    times = []
    for _ in range(5):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return min(times)


def main():
    size = int(sys.argv[1]) if len(sys.argv) > 1 else 512
    root = pathlib.Path(__file__).resolve().parents[2]
    command = ["cargo", "run", "--release", "--quiet", "-p", "noisefloor-benchmarks", "--example", "nlm", str(size)]
    text = subprocess.run(command, cwd=root, check=True, capture_output=True, text=True).stdout
    _, level, seconds = text.strip().splitlines()[-1].split()
    ours = float(seconds)

    random = numpy.random.default_rng(1)
    rows, columns = numpy.mgrid[0:size, 0:size] // 40
    clean = 0.2 + 0.1 * ((columns * 3 + rows * 5) % 9)
    image = clean[..., None] + 0.05 * random.standard_normal((size, size, 3))
    bytes_ = numpy.clip(255 * image, 0, 255).astype(numpy.uint8)
    floats = image.astype(numpy.float32)

    cv2.setNumThreads(1)
    opencv = best(lambda: cv2.fastNlMeansDenoisingColored(bytes_, None, 13, 13, 7, 21))
    opencv_plain = best(lambda: cv2.fastNlMeansDenoising(bytes_, None, 13, 7, 21))
    scikit = best(
        lambda: denoise_nl_means(
            floats, patch_size=7, patch_distance=10, h=0.05, sigma=0.05, fast_mode=True, channel_axis=-1
        )
    )
    print(f"{size}x{size} pixels, 3 channels, window 21x21, patch 7x7, one thread, minimum of 5 runs")
    print(f"{'program':<44}{'seconds':>10}{'times ours':>12}")
    for name, value in [
        (f"this engine, {level}, variances and 2x3 targets", ours),
        (f"OpenCV {cv2.__version__} fastNlMeansDenoising, 8 bit", opencv_plain),
        (f"OpenCV {cv2.__version__} ...DenoisingColored, 8 bit", opencv),
        (f"scikit-image {skimage.__version__} fast mode, f32", scikit),
    ]:
        print(f"{name:<44}{value:>10.3f}{value / ours:>12.1f}")


if __name__ == "__main__":
    main()
