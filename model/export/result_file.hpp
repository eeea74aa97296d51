#pragma once
// A forward result as an HDF5 file: the blocks of result_fields.hpp as groups, each number as a dataset named
// without its unit, with the attributes "units" and "description"; arrays over teeth have these as their
// dimension scale. The gear file that the result came from is in /config.
//
//   /config /gear /fidelity /version /status /message (texts)
//   /wave_generator/*  /backlash/*  /assembly/*  /compliance/{tooth, matrix}  /stiffness/*  /certificate/*
//   /load/0000/{rotation, torque, tooth, phi, force, loaded_backlash, …}  in the order of the gear's loads
//   /path/{start_rotation, …, events/{rotation, torque, stiffness, …}, changes/{event, tooth, joins, …},
//   loads/*}

#include "strainwave/model/results/load_path.hpp"
#include "strainwave/model/results/result.hpp"

#include <filesystem>
#include <string>

namespace strainwave {

/// Throws std::system_error with the cause when the file cannot be written.
void write_result_file(const ForwardResult& result, const std::string& config,
                       const std::filesystem::path& path, const LoadPath* load_path = nullptr);

} // namespace strainwave
