#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills renders and checks that nothing is lost.

test_kills.py [--kills N] [--seed S] [LAMPYRIS]: kills a render with a checkpoint N times (default
5; 100 before a release) with SIGKILL at random moments, resumes it each time, and compares the
final image, bit for bit, with that of an uninterrupted run. Ends with 1 where they differ.
"""
import argparse
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

SCENE = """Integrator "path" "integer maxdepth" 3
Sampler "bluenoise" "integer pixelsamples" {samples}
PixelFilter "mitchell"
Film "image" "integer xresolution" 200 "integer yresolution" 150 "string filename" "a.pfm"
LookAt 0 -3 1  0 0 0  0 0 1
Camera "perspective" "float fov" 45
WorldBegin
LightSource "infinite" "rgb L" [0.5 0.6 0.7]
LightSource "point" "point from" [1 -1 2]
Material "matte" "rgb Kd" [0.6 0.5 0.4]
Shape "sphere" "float radius" 0.7
WorldEnd
"""


class Render:
    def __init__(self, binary, folder, samples):
        self.binary, self.folder = binary, folder
        (folder / "scene.pbrt").write_text(SCENE.format(samples=samples))

    def start(self, output, *options):
        return subprocess.Popen([self.binary, "--quiet", "-o", output, *options, "scene.pbrt"],
                                cwd=self.folder, stderr=subprocess.PIPE)

    def finish(self, output, *options):
        process = self.start(output, *options)
        error = process.communicate()[1].decode()
        if process.returncode != 0:
            sys.exit(f"exit code {process.returncode}: {error}")
        return (self.folder / output).read_bytes()

    def resumable(self):
        """The options of a run that goes on from where the last one was killed."""
        options = ["--checkpoint", "c", "--checkpoint-interval", "0"]
        return options + ["--resume", "c"] if (self.folder / "c").exists() else options


def kill_and_resume(render, kills, seconds, rng):
    """The images of renders that were killed and resumed until they came to their end, `kills`
    times in all."""
    while kills > 0:
        (render.folder / "c").unlink(missing_ok=True)
        image = None
        while image is None:
            if kills == 0:
                image = render.finish("killed.pfm", *render.resumable())
                break
            process = render.start("killed.pfm", *render.resumable())
            try:
                error = process.communicate(timeout=rng.uniform(0, seconds / 2))[1]
            except subprocess.TimeoutExpired:
                process.kill()
                error = process.communicate()[1]
                kills -= 1
            else:
                if not (render.folder / "killed.pfm").exists():
                    sys.exit("a render came to its end without an image")
                image = (render.folder / "killed.pfm").read_bytes()
            if error:
                sys.exit(f"a run before its kill: {error.decode()}")
        yield image


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--kills", type=int, default=5)
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    parser.add_argument("binary", nargs="?", default=os.environ.get("LAMPYRIS_BINARY"))
    arguments = parser.parse_args()
    rng = random.Random(arguments.seed)
    with tempfile.TemporaryDirectory() as name:
        render = Render(os.path.abspath(arguments.binary), pathlib.Path(name), samples=64)
        start = time.monotonic()
        whole = render.finish("whole.pfm")
        seconds = time.monotonic() - start
        images = list(kill_and_resume(render, arguments.kills, seconds, rng))
        left = sorted(p.name for p in render.folder.glob("*.tmp"))
    if any(image != whole for image in images):
        sys.exit(f"an image differs from that of a run without kills (--seed {arguments.seed})")
    if left:
        sys.exit(f"temporary files are left: {', '.join(left)} (--seed {arguments.seed})")
    print(f"{arguments.kills} kills, {len(images)} images, same bits (seed {arguments.seed})")


if __name__ == "__main__":
    main()
