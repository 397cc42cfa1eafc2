#!/usr/bin/env python3
"""wheel_tag.py: gives wheels the platform tag that their library allows, or checks it

    wheel_tag.py WHEEL ...            renames each wheel to its tag, and prints the name
    wheel_tag.py --check WHEEL ...    ends with 1 if a wheel has another tag, or a damaged RECORD

The tag is what pip compares with the system. It follows from the library inside:

    manylinux_2_N_ARCH    the newest version of glibc's symbols that it asks for is GLIBC_2.N
    musllinux_1_N_ARCH    linked with musl; N is the version on this machine, as names have none
    win_amd64             a DLL for 64-bit Windows

A library is refused if it needs another one that not every system of the tag has, if it has a path
for libraries, or if it exports a name that libsparse_local.map does not. It is read by objdump
(OBJDUMP).
"""
import base64
import fnmatch
import hashlib
import os
import re
import subprocess
import sys
import tempfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
MAPS = [os.path.join(HERE, folder, "libsparse_local.map") for folder in ("../packaging", "csrc")]
ELF, PE = {62: "x86_64", 183: "aarch64"}, {0x8664: "win_amd64", 0xaa64: "win_arm64"}
GLIBC = r"lib(c|m|pthread|dl|rt)\.so\.[0-9]+|ld-linux-[-\w]+\.so\.[0-9]+"
MUSL = r"libc\.so|libc\.musl-\w+\.so\.1"
WINDOWS = r"kernel32\.dll|msvcrt\.dll|ucrtbase\.dll|api-ms-win-crt-[-\w]+\.dll"
# a pip older than 20.3 knows these names alone; 2.5 is the first version that any pip accepts
NICKNAMES = {5: "manylinux1", 12: "manylinux2010", 17: "manylinux2014"}


class Refused(Exception):
    pass


def objdump(option, path):
    return subprocess.run([os.environ.get("OBJDUMP", "objdump"), option, path], check=True,
                          capture_output=True, text=True).stdout


def only(needed, allowed, where):
    for name in needed:
        if not re.fullmatch(allowed, name, re.I):
            raise Refused("it needs %s, which not every system with %s has" % (name, where))


def check_exports(names):
    """Are there exports, and does the version script export each of them?"""
    with open(next(filter(os.path.exists, MAPS))) as file:
        patterns = re.findall(r"[^\s;]+(?=;)", file.read().split("global:")[1].split("local:")[0])
    for name in names:
        if not any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns):
            raise Refused("it exports %s" % name)
    if not names:
        raise Refused("it exports nothing")


def symbols(path):
    """What an ELF library exports, and the versions of the names that it asks for."""
    exports, versions = [], set()
    for line in objdump("-T", path).splitlines():
        match = re.match(r"[0-9a-f]{8,} .{7} (\S+)\s+[0-9a-f]{8,}\s+(.*)", line)
        if match and match.group(1) == "*UND*":
            versions.update(re.findall(r"\(?\b(\w+_\d[\d.]*)\)?\s", match.group(2)))
        elif match and match.group(1) != "*ABS*":
            exports.append(match.group(2).split()[-1])
    return exports, versions


def musl_version(arch):
    """1.N, as musl's loader says when it is run without a program."""
    loader = "/lib/ld-musl-%s.so.1" % arch
    try:
        said = subprocess.run([loader], capture_output=True, text=True).stderr
        return re.search(r"^Version (\d+)\.(\d+)", said, re.M).groups()
    except (OSError, AttributeError):
        raise Refused("%s does not say its version" % loader)


def elf_tags(path, arch):
    headers = objdump("-p", path)
    if re.search(r"^\s+(RPATH|RUNPATH)\s", headers, re.M):
        raise Refused("it has a path for libraries (RPATH)")
    needed = re.findall(r"^\s+NEEDED\s+(\S+)", headers, re.M)
    exports, versions = symbols(path)
    check_exports(exports)
    if any(re.fullmatch(MUSL, name) for name in needed):
        only(needed, MUSL, "musl")
        return ["musllinux_%s_%s_%s" % (*musl_version(arch), arch)]
    only(needed, GLIBC, "glibc")
    newest = 5 if arch == "x86_64" else 17
    for version in versions:
        match = re.fullmatch(r"GLIBC_2\.(\d+)(\.\d+)*", version)
        if not match:
            raise Refused("it asks for %s" % version)
        newest = max(newest, int(match.group(1)))
    nickname = [NICKNAMES[n] for n in sorted(NICKNAMES) if n >= newest][:1]
    return ["%s_%s" % (name, arch) for name in ["manylinux_2_%d" % newest] + nickname]


def library_tags(path):
    """The platform tags of a library, or Refused."""
    with open(path, "rb") as file:
        head = file.read(4096)
    if head[:6] == b"\x7fELF\2\1":  # 64 bits, little endian
        machine = int.from_bytes(head[18:20], "little")
        if machine in ELF:
            return elf_tags(path, ELF[machine])
    if head[:2] == b"MZ":
        at = int.from_bytes(head[60:64], "little") + 4
        machine = int.from_bytes(head[at:at + 2], "little")
        if machine in PE:
            headers = objdump("-p", path)
            only(re.findall(r"DLL Name: (\S+)", headers), WINDOWS, "Windows")
            check_exports(re.findall(  # newer objdumps print the ordinal, too
                r"^\s+\[ *\d+\](?: \+base\[ *\d+\]\s+[0-9a-f]+)? ([^\s+]\S*)$", headers, re.M))
            return [PE[machine]]
    raise Refused("it is a library of an unknown kind")


def wheel_tags(wheel):
    """The tags of the one library in a wheel."""
    found = [name for name in wheel.namelist() if re.search(r"\.(so|dll|dylib)$", name)]
    if len(found) != 1:
        raise Refused("it has %d libraries, and not one" % len(found))
    with tempfile.TemporaryDirectory() as folder:
        return library_tags(wheel.extract(found[0], folder))


def record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return "%s,sha256=%s,%d" % (name, digest, len(data))


def set_tags(path):
    """Writes the wheel with its tag, removes the one before, and returns the new path."""
    with zipfile.ZipFile(path) as wheel:
        tags = wheel_tags(wheel)
        files = [(info, wheel.read(info)) for info in wheel.infolist()]
    prefix = os.path.basename(path)[:-4].rsplit("-", 1)[0]
    new, part = "%s-%s.whl" % (prefix, ".".join(tags)), path + ".part"
    kind = "-".join(prefix.split("-")[-2:])
    lines = "".join("Tag: %s-%s\n" % (kind, tag) for tag in tags)
    with zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as wheel:
        record = []
        for info, data in files:
            if info.filename.endswith(".dist-info/WHEEL"):
                text = re.sub(r"(?m)^Tag: .*\n", "", data.decode()).rstrip("\n")
                data = (text + "\n" + lines).encode()
            if info.filename.endswith(".dist-info/RECORD"):
                record.append(info.filename + ",,")
                data = ("\n".join(record) + "\n").encode()
            else:
                record.append(record_line(info.filename, data))
            wheel.writestr(info, data, zipfile.ZIP_DEFLATED)
    os.remove(path)
    new = os.path.join(os.path.dirname(path), new)
    os.replace(part, new)
    return new


def check(path):
    """Refused unless name, WHEEL and RECORD say what is inside."""
    with zipfile.ZipFile(path) as wheel:
        tags = wheel_tags(wheel)
        files = {name: wheel.read(name) for name in wheel.namelist()}
    name = os.path.basename(path)[:-4].rsplit("-", 1)[1]
    if name != ".".join(tags):
        raise Refused("its name has the tag %s, and its library allows %s" % (name, ".".join(tags)))
    info = {name.rsplit("/", 1)[1]: files[name].decode() for name in files
            if re.search(r"\.dist-info/(WHEEL|RECORD)$", name)}
    if re.findall(r"^Tag: .*-(\S+)$", info["WHEEL"], re.M) != tags:
        raise Refused("its file WHEEL has other tags than its library allows")
    lines = set(info["RECORD"].splitlines())
    for name, data in files.items():
        if not name.endswith("/RECORD") and record_line(name, data) not in lines:
            raise Refused("its RECORD does not have %s as it is" % name)


def main(arguments):
    status = 0
    for path in [name for name in arguments if name != "--check"]:
        try:
            if "--check" in arguments:
                check(path)
            else:
                path = set_tags(path)
            print(path)
        except Refused as reason:
            print("wheel_tag.py: %s: %s" % (path, reason), file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
