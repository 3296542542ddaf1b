"""The page on PyPI: the README, whose links lead somewhere from there too.

PyPI shows no files of a repository: what the README links to by path has the address of the repository before it. As
long as that has none (``address`` in pyproject.toml), links become plain words and pictures are left out.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

_LINK = re.compile(r"(?P<picture>!?)\[(?P<words>[^\]]*)\]\((?P<to>[^)\s]+)\)")


def page(readme: str, address: str) -> str:
    """Return a README for elsewhere.

    Parameters
    ----------
    readme : str
        In Markdown.
    address : str
        Where the repository is shown, without a slash at the end; empty where it is nowhere.
    """

    def changed(link: re.Match[str]) -> str:
        picture, words, to = link["picture"], link["words"], link["to"]
        if "://" in to or to.startswith("#"):
            return link[0]
        if address:
            return f"{picture}[{words}]({address}/{'raw' if picture else 'blob'}/main/{to})"
        return "" if picture else words

    return re.sub(r"\n{3,}", "\n\n", _LINK.sub(changed, readme))


class PageOnPypi(MetadataHookInterface):
    """Gives the README, and the addresses of the project if it has one."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Add what is dynamic in pyproject.toml."""
        address = self.config["address"]
        text = page((Path(self.root) / "README.md").read_text(encoding="utf-8"), address)
        metadata["readme"] = {"content-type": "text/markdown", "text": text}
        if address:
            metadata["urls"] = {
                "Source": address,
                "Documentation": f"{address}/blob/main/docs/index.md",
                "Changelog": f"{address}/blob/main/CHANGELOG.md",
                "Issues": f"{address}/issues",
            }
