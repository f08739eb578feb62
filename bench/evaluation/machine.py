# SPDX-License-Identifier: Apache-2.0
"""Where a measurement was made, and of what."""
import os
import platform
import re
import subprocess

from .suite import ROOT


def _grep(path, pattern):
    try:
        with open(path, errors="replace") as f: found = re.search(pattern, f.read(), re.M)
    except OSError: return ""
    return found.group(1).strip() if found else ""


def _output(*command):
    try: return subprocess.run(command, capture_output=True, text=True, timeout=10).stdout.strip()
    except (OSError, subprocess.SubprocessError): return ""


def machine():
    kib = _grep("/proc/meminfo", r"^MemTotal:\s+(\d+)")
    return {"processor": _grep("/proc/cpuinfo", r"^model name\s*:\s*(.*)$") or platform.machine(),
            "logical processors": os.cpu_count(),
            "memory": "%.0f GiB" % (int(kib) / 2 ** 20) if kib else "",
            "system": "%s %s" % (_grep("/etc/os-release", r'^PRETTY_NAME="?([^"\n]*)') or platform.system(),
                                 platform.machine())}


def build(binary):
    folder = os.path.dirname(os.path.abspath(binary))
    cache = os.path.join(folder, "CMakeCache.txt")
    compiler = _grep(cache, r"^CMAKE_CXX_COMPILER:\w+=(.*)$")
    return {"program": _output(binary, "--version"),
            "revision": _output("git", "-C", ROOT, "describe", "--always", "--dirty"),
            "build type": _grep(cache, r"^CMAKE_BUILD_TYPE:\w+=(.*)$"),
            "compiler": _output(compiler, "--version").partition("\n")[0] if compiler else ""}
