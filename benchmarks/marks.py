"""What a benchmark writes into a page stands between marks that name it."""

from __future__ import annotations

END = "<!-- end -->"


def renewed(page: str, text: str, script: str) -> str:
    """Return a page with what stands between a benchmark's marks replaced.

    Parameters
    ----------
    page : str
        Markdown.
    text : str
        What is to stand there.
    script : str
        File name of the benchmark.

    Raises
    ------
    ValueError
        If the page has not each mark once.
    """
    begin = f"<!-- written by benchmarks/{script} --update -->"
    if page.count(begin) != 1 or page.count(END) != 1:
        raise ValueError(f"the page needs '{begin}' and '{END}', once each")
    before, _, rest = page.partition(begin)
    return f"{before}{begin}\n{text}\n{END}{rest.partition(END)[2]}"
