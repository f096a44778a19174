"""Numbers of a run of blasting as engineers ask for them: sizes of fragments, vibration, damage around holes, energy.

    import sazare
    from sazare.blast import BlastNumbers, Settings

    numbers = BlastNumbers(sazare.open("runs/bench"), Settings(oversize=0.8, charges=(28.6,)))
    numbers.sieve.size_at(0.5), numbers.sieve.oversize(0.8)          # P50 [m], share of the mass
    [(one.name, one.ppv, one.frequency) for one in numbers.shaken]   # m/s, Hz
    {one.name: one.radius(0.5) for one in numbers.damages}           # m
"""

from sazare.blast.numbers import BlastNumbers, write_numbers
from sazare.blast.settings import Settings, read_settings

__all__ = ["BlastNumbers", "Settings", "read_settings", "write_numbers"]
