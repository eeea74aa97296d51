#pragma once
// A forward result as an HDF5 file: one dataset per quantity, its unit in the attribute "units", the gear
// file it came from in /config. Written beside the target and renamed into place, so that a reader never sees
// half a file.
//
//   /config (text)  /version (text)  /status (text)  /message (text)  /fidelity (text)
//   /wave_generator/*  /backlash/*  /assembly/*  /compliance/{tooth, matrix}  /stiffness/*  /certificate/*
//   /load/0000/{rotation, torque, tooth, phi, force, loaded_backlash, …}  in the order of the gear's loads

#include "strainwave/model/results/result.hpp"

#include <filesystem>
#include <string>

namespace strainwave {

/// Throws std::system_error with the cause when the file cannot be written.
void write_result_file(const ForwardResult& result, const std::string& config,
                       const std::filesystem::path& path);

} // namespace strainwave
