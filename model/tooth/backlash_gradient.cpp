namespace strainwave {}
