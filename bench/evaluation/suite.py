# SPDX-License-Identifier: Apache-2.0
"""A suite file: scenes x variants, how long, how often. docs/evaluation.md describes the format."""
import json
import os
from dataclasses import dataclass, field

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


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
class Curve:
    spp: list = field(default_factory=list)
    repetitions: int = 1


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
    curve: Curve = None


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
    curve: Curve = field(default_factory=Curve)

    def scene_variants(self, scene):
        """The variants to run, the base first, then as listed."""
        wanted = scene.variants or [v.name for v in self.variants]
        chosen = [v for v in self.variants if v.name in wanted]
        return sorted(chosen, key=lambda v: v.name != self.scene_base(scene))

    def scene_base(self, scene): return scene.base or self.base
    def scene_seconds(self, scene): return scene.seconds or self.seconds
    def scene_reference(self, scene): return scene.reference or self.reference
    def scene_curve(self, scene): return scene.curve or self.curve
    def scene_define(self, scene): return self.define + scene.define


def _made(kind, data, where):
    if not isinstance(data, dict): raise SuiteError("%s: expected an object" % where)
    unknown = set(data) - set(kind.__dataclass_fields__)
    if unknown: raise SuiteError("%s: unknown: %s; there are: %s" % (
        where, ", ".join(sorted(unknown)), ", ".join(kind.__dataclass_fields__)))
    try: return kind(**data)
    except TypeError as e: raise SuiteError("%s: %s" % (where, e))


def parse(data, where="suite"):
    suite = _made(Suite, data, where)
    suite.reference = _made(Reference, suite.reference, where + ", reference")
    if isinstance(suite.curve, dict): suite.curve = _made(Curve, suite.curve, where + ", curve")
    suite.variants = [_made(Variant, v, where + ", variants") for v in suite.variants]
    suite.scenes = [_made(Scene, s, where + ", scenes") for s in suite.scenes]
    for s in suite.scenes:
        if s.reference: s.reference = _made(Reference, s.reference, "%s, scene %s" % (where, s.name))
        if s.curve: s.curve = _made(Curve, s.curve, "%s, scene %s" % (where, s.name))
    _check(suite, where)
    return suite


def _check(suite, where):
    names = [v.name for v in suite.variants]
    for kind, listed in (("variant", names), ("scene", [s.name for s in suite.scenes])):
        for n in listed:
            if not n or os.path.basename(n) != n or n.startswith("."):
                raise SuiteError("%s: '%s' is no name for a folder" % (where, n))
        if len(set(listed)) < len(listed): raise SuiteError("%s: two %ss of one name" % (where, kind))
    for s in suite.scenes:
        if bool(s.file) == bool(s.generate): raise SuiteError("scene %s: either 'file' or 'generate'" % s.name)
        here = s.variants or names
        for n in [*here, suite.scene_base(s)]:
            if n not in names: raise SuiteError("scene %s: no variant '%s'" % (s.name, n))
        if suite.scene_base(s) not in here: raise SuiteError("scene %s: its base is not among its variants" % s.name)
        r = suite.scene_reference(s)
        if bool(r.seconds) == bool(r.spp):
            raise SuiteError("scene %s: a reference has either 'seconds' or 'spp'" % s.name)


def read(path):
    """Scene files are relative to the suite file."""
    with open(path) as f:
        try: data = json.load(f)
        except ValueError as e: raise SuiteError("%s: %s" % (path, e))
    suite = parse(data, path)
    for s in suite.scenes:
        if s.file: s.file = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(path)), s.file))
    return suite
