"""Build the conda package from the sdist where no channel can be reached, and run the recipe's tests.

    python -m build --sdist
    pip install py-rattler-build
    python packaging/conda/build.py --out out/conda

rattler-build solves, builds and tests against a channel of this machine. Its `python` is the Python that runs this,
`pip` and `hatchling` come from PyPI, and so does what the recipe's tests import. Others that it asks for are
there by name and version alone, so that what needs SymPy or CasADi is not tried here: `make test` does that.
"""

from __future__ import annotations

import argparse
import hashlib
import io
import json
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
SITE = f"lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages"
IMPORTED = ("click", "rich", "pydantic", "jinja2", "platformdirs", "tomlkit", "numpy")
"""Of what the recipe asks for: what its tests import."""


class Channel:
    """A folder of conda packages with its index."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.index = folder, dict[str, Any]()
        for subfolder in ("linux-64", "noarch"):
            (folder / subfolder).mkdir(parents=True)
        self._write()

    def add(
        self,
        name: str,
        version: str,
        files: Mapping[str, bytes],
        *depends: str,
        links: Mapping[str, str] | None = None,
    ) -> None:
        """Add a package: files by path, other packages it needs, links and where they lead."""
        about: dict[str, Any] = {"name": name, "version": version, "build": "0", "build_number": 0}
        about |= {"depends": depends, "subdir": "linux-64", "license": "other"}
        paths = [_path(path, "hardlink", data) for path, data in files.items()]
        paths += [_path(path, "softlink", b"") for path in links or {}]
        info = {"info/index.json": about, "info/paths.json": {"paths": paths, "paths_version": 1}}
        packed = self.folder / "linux-64" / f"{name}-{version}-0.tar.bz2"
        with tarfile.open(packed, "w:bz2", compresslevel=1) as archive:
            for path, data in {**files, **{k: json.dumps(v).encode() for k, v in info.items()}}.items():
                entry = tarfile.TarInfo(path)
                entry.size, entry.mode = len(data), 0o644
                archive.addfile(entry, io.BytesIO(data))
            for path, target in (links or {}).items():
                entry = tarfile.TarInfo(path)
                entry.type, entry.linkname = tarfile.SYMTYPE, target
                archive.addfile(entry)
        whole = packed.read_bytes()
        sums = {"sha256": hashlib.sha256(whole).hexdigest(), "md5": hashlib.md5(whole).hexdigest()}
        self.index[packed.name] = {**about, **sums, "size": len(whole)}
        self._write()

    def _write(self) -> None:
        for subfolder, packages in (("linux-64", self.index), ("noarch", {})):
            listed = {"info": {"subdir": subfolder}, "packages": packages, "packages.conda": {}}
            (self.folder / subfolder / "repodata.json").write_text(json.dumps(listed))


def _path(path: str, kind: str, data: bytes) -> dict[str, object]:
    found = {"_path": path, "path_type": kind, "sha256": hashlib.sha256(data).hexdigest()}
    return {**found, "size_in_bytes": len(data)}


def installed(names: tuple[str, ...], folder: Path) -> dict[str, bytes]:
    """Return the files of packages from PyPI, and of what they need, by where an environment has them."""
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--target", str(folder), *names]
    subprocess.run(command, check=True)
    return {
        f"{SITE}/{path.relative_to(folder)}": path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.relative_to(folder).parts[0] != "bin"
    }


def main() -> None:
    """Make the channel, build, test."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/conda"), help="folder of the package")
    out: Path = parser.parse_args().out
    recipe = (HERE / "recipe.yaml").read_text()
    with tempfile.TemporaryDirectory() as folder:
        channel, scratch = Channel(Path(folder, "channel")), Path(folder)
        # packages that stand for others must not stay in anybody's cache
        os.environ["RATTLER_CACHE_DIR"] = str(scratch / "cache")
        import rattler_build

        base = Path(sys.base_prefix, "bin")
        version = ".".join(map(str, sys.version_info[:3]))
        own = f"home = {base}\nversion = {version}\n".encode()  # as of a virtual environment
        # entry points of packages without machine code call Python by its version
        named = ("python", "python3", f"python{sys.version_info.major}.{sys.version_info.minor}")
        programs = {f"bin/{name}": str(base / "python3") for name in named}
        channel.add("python", version, {"pyvenv.cfg": own}, links=programs)
        channel.add("pip", "99", installed(("pip",), scratch / "pip"), "python")
        channel.add("hatchling", "99", installed(("hatchling",), scratch / "hatchling"), "python")
        channel.add("imported", "99", installed(IMPORTED, scratch / "imported"), "python")
        asked = recipe.partition("  run:\n")[2].partition("\n\n")[0]
        for name, least in re.findall(r"- ([\w-]+) >=(\S+)", asked):
            if name != "python":
                channel.add(name, least, {f"share/{name}": b"by name alone\n"}, "imported")
        warnings.simplefilter("ignore", DeprecationWarning)
        rattler_build.build_recipes(
            [HERE / "recipe.yaml"],
            channel=[channel.folder.as_uri()],
            output_dir=out,
            test="native-and-emulated",
            noarch_build_platform="linux-64",
            use_zstd=False,
            use_bz2=False,
            use_sharded=False,
        )
    for package in sorted(out.glob("noarch/*.conda")):
        print(f"built and tested {package}")


if __name__ == "__main__":
    main()
