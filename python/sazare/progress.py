"""How far a simulation is: a line that is written over on a terminal and in a notebook, a new one now and then elsewhere."""

import sys
import time

LINE_INTERVAL = 5.0  # s


def in_notebook():
    """Whether this is the kernel of a notebook."""
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    return shell is not None and hasattr(shell, "kernel")


class ProgressLine:
    """Shows texts, one at a time; used as a context, it takes the last one away where it can."""

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
        """Shows a text if it is time for it; `text` is called only then."""
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
