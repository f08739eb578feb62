# SPDX-License-Identifier: Apache-2.0
"""A suite file: scenes x variants, how long, how often. docs/evaluation.md describes the format."""
import json
import math
import os
from dataclasses import dataclass, field

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

SHORTEST_SNAPSHOT = .01  # seconds
QUICK, QUICK_REPETITIONS = .1, 3
AOV_SHARE = .25  # of the time of a run, for one that tells what happens in it


class SuiteError(Exception):
    pass


@dataclass
class Variant:
    name: str
    define: list = field(default_factory=list)
    title: str = ""


@dataclass
class Reference:
    """Two halves of `seconds` or of `spp` each."""
    define: list = field(default_factory=list)
    seconds: float = 0
    spp: int = 0


@dataclass
class Scene:
    name: str
    title: str = ""
    file: str = ""
    generate: list = field(default_factory=list)
    define: list = field(default_factory=list)
    seconds: float = 0
    variants: list = field(default_factory=list)
    base: str = ""
    reference: Reference = None
    quick: dict = field(default_factory=dict)  # what is different with --quick


@dataclass
class Suite:
    name: str
    base: str
    variants: list
    scenes: list
    reference: Reference
    title: str = ""
    description: str = ""
    seconds: float = 10
    repetitions: int = 5
    threads: int = 0
    define: list = field(default_factory=list)
    snapshots: int = 6
    mask: Reference = None  # a render: pixels that are not black in it count nowhere

    def scene_variants(self, scene):
        """The variants to run, the base first, then as listed."""
        wanted = scene.variants or [v.name for v in self.variants]
        chosen = [v for v in self.variants if v.name in wanted]
        return sorted(chosen, key=lambda v: v.name != self.scene_base(scene))

    def scene_base(self, scene): return scene.base or self.base
    def scene_seconds(self, scene): return scene.seconds or self.seconds
    def scene_reference(self, scene): return scene.reference or self.reference
    def scene_define(self, scene): return self.define + scene.define

    def snapshot_seconds(self, scene):
        """When curves have points: halves of the time of a run, quarters, …; the run's end comes last by itself."""
        times = [self.scene_seconds(scene) / 2 ** k for k in range(self.snapshots, 0, -1)]
        return [t for t in times if t >= SHORTEST_SNAPSHOT]

    def quicken(self):
        """A tenth of the time, or a little more. Three repetitions are the fewest that tell an interval worth its name."""
        self.name, self.title = self.name + "-quick", (self.title or self.name) + " (quick)"
        self.repetitions = min(self.repetitions, QUICK_REPETITIONS)
        for s in [self, *self.scenes]: s.seconds *= QUICK
        for r in [self.reference, *(s.reference for s in self.scenes if s.reference)]:
            r.seconds, r.spp = r.seconds * QUICK, math.ceil(r.spp * QUICK)

    def expected_seconds(self):
        """Of all renders, loading left out; and how many renders these are."""
        references = {(s.file, *s.generate, *self.scene_define(s), *self.scene_reference(s).define):
                      2 * self.scene_reference(s).seconds for s in self.scenes}
        masks = len({(s.file, *s.generate) for s in self.scenes}) if self.mask else 0
        runs = [(self.scene_seconds(s), len(self.scene_variants(s))) for s in self.scenes]
        return (sum(references.values()) + sum(t * n * (self.repetitions + AOV_SHARE) for t, n in runs),
                2 * len(references) + masks + sum(n * (self.repetitions + 1) for _, n in runs))


def _made(kind, data, where):
    if not isinstance(data, dict): raise SuiteError("%s: expected an object" % where)
    unknown = set(data) - set(kind.__dataclass_fields__)
    if unknown: raise SuiteError("%s: unknown: %s; there are: %s" % (
        where, ", ".join(sorted(unknown)), ", ".join(kind.__dataclass_fields__)))
    try: return kind(**data)
    except TypeError as e: raise SuiteError("%s: %s" % (where, e))


def parse(data, where="suite", quick=False):
    suite = _made(Suite, data, where)
    suite.reference = _made(Reference, suite.reference, where + ", reference")
    if suite.mask: suite.mask = _made(Reference, suite.mask, where + ", mask")
    suite.variants = [_made(Variant, v, where + ", variants") for v in suite.variants]
    suite.scenes = [_made(Scene, {**s, **(s.get("quick", {}) if quick else {})}, where + ", scenes") for s in suite.scenes]
    for s in suite.scenes:
        if s.reference: s.reference = _made(Reference, s.reference, "%s, scene %s" % (where, s.name))
    _check(suite, where)
    if quick: suite.quicken()
    return suite


def _check(suite, where):
    names = [v.name for v in suite.variants]
    for kind, listed in (("variant", names), ("scene", [s.name for s in suite.scenes])):
        for n in listed:
            if not n or os.path.basename(n) != n or n.startswith("."):
                raise SuiteError("%s: '%s' is no name for a folder" % (where, n))
        if len(set(listed)) < len(listed): raise SuiteError("%s: two %ss of one name" % (where, kind))
    if suite.mask and not (suite.mask.spp and not suite.mask.seconds): raise SuiteError("%s: a mask has 'spp'" % where)
    for s in suite.scenes:
        if bool(s.file) == bool(s.generate): raise SuiteError("scene %s: either 'file' or 'generate'" % s.name)
        here = s.variants or names
        for n in [*here, suite.scene_base(s)]:
            if n not in names: raise SuiteError("scene %s: no variant '%s'" % (s.name, n))
        if suite.scene_base(s) not in here: raise SuiteError("scene %s: its base is not among its variants" % s.name)
        r = suite.scene_reference(s)
        if bool(r.seconds) == bool(r.spp):
            raise SuiteError("scene %s: a reference has either 'seconds' or 'spp'" % s.name)


def read(path, quick=False):
    """Scene files are relative to the suite file."""
    with open(path) as f:
        try: data = json.load(f)
        except ValueError as e: raise SuiteError("%s: %s" % (path, e))
    suite = parse(data, path, quick)
    for s in suite.scenes:
        if s.file: s.file = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(path)), s.file))
    return suite
