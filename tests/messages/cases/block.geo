// an empty geometry
