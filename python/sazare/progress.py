"""Progress of a simulation: one line that is updated on a terminal and in a notebook, a new line now and then elsewhere."""

import sys
import time

LINE_INTERVAL = 5.0  # s


def in_notebook():
    """Whether this is the kernel of a notebook."""
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    return shell is not None and hasattr(shell, "kernel")


class ProgressLine:
    """Shows one text at a time; as a context manager, it clears the last one where it can."""

    def __init__(self, shown=True, stream=None):
        self._stream = sys.stdout if stream is None else stream
        self._shown = shown
        self._over = self._stream.isatty() or in_notebook()
        self._width = 0
        self._next = time.monotonic() + (0.0 if self._over else LINE_INTERVAL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._width:
            self._write("\r" + " " * self._width + "\r")
            self._width = 0

    def show(self, text):
        """Shows a text if one is due; `text` is called only then."""
        if not self._shown or time.monotonic() < self._next:
            return
        line = text()
        if self._over:
            self._write("\r" + line.ljust(self._width))
            self._width = len(line)
        else:
            self._write(line + "\n")
            self._next = time.monotonic() + LINE_INTERVAL

    def _write(self, text):
        self._stream.write(text)
        self._stream.flush()
