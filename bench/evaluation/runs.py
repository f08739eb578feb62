# SPDX-License-Identifier: Apache-2.0
"""Renders, each kept as a file, so that a suite that was interrupted goes on where it was."""
import hashlib
import json
import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import dataclass

from .suite import ROOT

FILES = re.compile(rb'"([^"\n]+\.(?:ply|pbrt|exr|png|tga|pfm|hdr|jpg|spd|gz))"')


@dataclass(frozen=True)
class Task:
    """One render. `where` is the folder and stem of its files, relative to the output folder."""
    where: str
    scene: str
    define: tuple
    limit: tuple  # ("--seconds", "2") or ("--spp", "64")
    seed: int
    snapshots: tuple = ()  # seconds
    aovs: tuple = ()
    judge: str = ""  # what the snapshots are held against: another one needs another run, for they aren't kept


class Failed(Exception):
    pass


def file_hash(path):
    """Of a file's content and that of the files it names (one level: meshes, textures, included scenes)."""
    digest = hashlib.sha256()
    with open(path, "rb") as f: content = f.read()
    digest.update(content)
    folder = os.path.dirname(path)
    for name in sorted(set(FILES.findall(content))):
        other = os.path.join(folder, os.fsdecode(name))
        if os.path.isfile(other):
            with open(other, "rb") as f: digest.update(name + b"\0" + hashlib.sha256(f.read()).digest())
    return digest.hexdigest()


def content_hash(path):
    with open(path, "rb") as f: return hashlib.sha256(f.read()).hexdigest()


def key_of(*parts):
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()[:16]


class Runner:
    def __init__(self, binary, out, threads, say=print):
        self.binary, self.out, self.threads, self.say = os.path.abspath(binary), os.path.abspath(out), threads, say
        self.binary_hash = file_hash(self.binary)
        self._hashes = {}

    def path(self, name): return os.path.join(self.out, name)

    def scene_hash(self, path):
        if path not in self._hashes: self._hashes[path] = file_hash(path)
        return self._hashes[path]

    def scene_file(self, scene):
        """Of a scene of the suite; made if it is one that the generator makes."""
        if not scene.generate: return scene.file
        folder = self.path("scenes")
        kind, *names = scene.generate
        script = os.path.join(ROOT, "scenes", "generate.py")
        subprocess.run([sys.executable, script, kind, folder, *names], check=True)
        return os.path.join(folder, names[0].partition("=")[0] + ".pbrt")

    def render(self, task, depends_on_binary=True, digest=None):
        """The record of the run, from its file if there is one that was made from the same things. `digest` is given
        a new record before it is kept."""
        key = key_of(self.scene_hash(task.scene), task.define, task.limit, task.seed, task.snapshots, task.aovs, task.judge,
                     [self.binary_hash, self.threads] if depends_on_binary else [])
        record_path = self.path(task.where + ".json")
        try:
            with open(record_path) as f: record = json.load(f)
            if record["key"] == key and os.path.exists(self.path(record["image"])): return record
        except (OSError, ValueError, KeyError): pass
        record = self._run(task)
        if digest: digest(record)
        record["key"] = key
        with open(record_path + ".tmp", "w") as f: json.dump(record, f, indent=1)
        os.replace(record_path + ".tmp", record_path)
        return record

    def _run(self, task):
        stem = self.path(task.where)
        os.makedirs(os.path.dirname(stem), exist_ok=True)
        image = task.where + (".exr" if task.aovs else ".pfm")
        command = [self.binary, task.scene, *task.limit, "--seed", str(task.seed), "--threads", str(self.threads),
                   "--stats", stem + ".stats.json", "--out", self.path(image), "-q"]
        if task.snapshots: command += ["--snapshots", ",".join("%gs" % t for t in task.snapshots)]
        if task.aovs: command += ["--aov", ",".join(task.aovs)]
        for d in task.define: command += ["-D", d]
        self.say("  %-50s %s" % (task.where, " ".join(task.limit)))
        before, busy_before = time.monotonic(), _busy_seconds()
        # A scene may take its time to load, but a render that was given seconds must end.
        allowed = 600 + 3 * float(task.limit[1]) if task.limit[0] == "--seconds" else 6 * 3600
        status, usage, text = _watched(command, stem + ".log", allowed)
        wall, busy = time.monotonic() - before, _busy_seconds() - busy_before
        if status: raise Failed("%s\n%s" % ("exit code %d" % status if status > 0 else "stopped by signal %d" % -status,
                                            text.strip()[-800:]))
        with open(stem + ".stats.json") as f: stats = json.load(f)
        cpu = usage.ru_utime + usage.ru_stime
        return {"image": image, "seed": task.seed, "limit": list(task.limit), "wall": wall, "cpu": cpu,
                "others": max(0., busy - cpu) / (wall * os.cpu_count()), "memory": usage.ru_maxrss * 1024,
                "stats": stats}


def _busy_seconds():
    """Of all processors together since the start of the machine; 0 where the system doesn't tell."""
    try:
        with open("/proc/stat") as f: user, nice, system, _, _, *interrupts = map(int, f.readline().split()[1:9])
    except (OSError, ValueError): return 0.
    return (user + nice + system + sum(interrupts)) / os.sysconf("SC_CLK_TCK")


def _watched(command, log, allowed):
    """Runs a command; returns its exit status (negative: signal), its resource usage and what it printed."""
    with open(log, "wb") as f:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=f, stderr=subprocess.STDOUT)
    # wait4, because it alone tells the memory of this one process.
    end, pid = time.monotonic() + allowed, 0
    try:
        while not pid:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if not pid and time.monotonic() > end:
                process.kill()
                pid, status, usage = os.wait4(process.pid, 0)
            elif not pid: time.sleep(.02)
    except KeyboardInterrupt:
        os.kill(process.pid, signal.SIGKILL)
        raise
    process.returncode = os.waitstatus_to_exitcode(status)
    with open(log, errors="replace") as f: return process.returncode, usage, f.read()
