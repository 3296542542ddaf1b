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
        If the page has not its mark once, and an end after it.
    """
    begin = f"<!-- written by benchmarks/{script} --update -->"
    before, _, rest = page.partition(begin)
    _, end, after = rest.partition(END)
    if page.count(begin) != 1 or not end:
        raise ValueError(f"the page needs '{begin}' once, and '{END}' after it")
    return f"{before}{begin}\n{text}\n{END}{after}"
