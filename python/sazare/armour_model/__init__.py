"""Cases of method spheres from an armour layer on a slope: parametric units, placed by a grid.

    from sazare.armour_model import KINDS, ArmourModel, Layout, Rules, Slope, unit_solid, write_model

    kind = KINDS["tetrapod"]
    solid = unit_solid(kind, size=1.3)                    # D_n [m]
    layout = Layout(Slope(toe=-8.0, crest=4.0, cot=1.5, width=12.0), kind, solid, Rules(packing=1.04))
    layout.number, layout.packing, layout.porosity
    write_model(ArmourModel(layout), "breakwater")
"""

from sazare.armour_model.layout import Layout, Rules, Slope
from sazare.armour_model.model import ArmourModel, Material, write_model
from sazare.armour_model.solids import Solid, read_stl, write_stl
from sazare.armour_model.units import KINDS, Kind, unit_solid

__all__ = ["KINDS", "ArmourModel", "Kind", "Layout", "Material", "Rules", "Slope", "Solid", "read_stl", "unit_solid", "write_model", "write_stl"]
