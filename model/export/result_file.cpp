#include "strainwave/model/export/result_file.hpp"

#include "strainwave/common/files/hdf5.hpp"
#include "strainwave/model/export/load_path_export.hpp"
#include "strainwave/model/results/result_fields.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>

namespace strainwave {

namespace {

/// Of a group that somebody else holds, or of its own.
class Hdf5Writer final : public ResultWriter {
public:
  explicit Hdf5Writer(const hdf5::Group& group) : group_(group) {}
  explicit Hdf5Writer(hdf5::Group&& own) : own_(std::move(own)), group_(*own_) {}

  void put(const FieldText& field, const ResultValue& value) override {
    const std::string name(name_without_unit(field));
    std::visit(
        [&](const auto& held) {
          using Held = std::remove_cvref_t<decltype(held)>;
          if constexpr (std::is_same_v<Held, bool>)
            describe(field, group_.put_number(name, std::uint8_t{held}));
          else if constexpr (std::is_same_v<Held, int> || std::is_same_v<Held, double>)
            describe(field, group_.put_number(name, held));
          else if constexpr (std::is_same_v<Held, std::string>)
            group_.put_text(name, held);
          else if constexpr (std::is_same_v<Held, std::vector<int>> ||
                             std::is_same_v<Held, std::vector<double>>)
            describe(field, group_.put(name, held));
          else if constexpr (std::is_same_v<Held, std::vector<std::vector<double>>>)
            describe(field, put_matrix(name, held));
        },
        value);
  }
  std::unique_ptr<ResultWriter> block(std::string_view name) override {
    return std::make_unique<Hdf5Writer>(group_.make_group(std::string(name)));
  }
  std::unique_ptr<ResultWriter> element(std::string_view list, std::size_t index) override {
    const std::string name(list);
    const hdf5::Group all = group_.has(name) ? group_.group(name) : group_.make_group(name);
    return std::make_unique<Hdf5Writer>(all.make_group(fmt::format("{:04}", index)));
  }
  void no_block(std::string_view) override {}

private:
  hdf5::Dataset put_matrix(const std::string& name, const std::vector<std::vector<double>>& rows) const {
    std::vector<double> flat;
    for (const auto& row : rows)
      flat.insert(flat.end(), row.begin(), row.end());
    return group_.put(name, flat, {rows.size(), rows.empty() ? 0 : rows.front().size()});
  }

  /// Unit and sentence beside the numbers; along each axis its scale.
  void describe(const FieldText& field, hdf5::Dataset dataset) {
    dataset.set_text("units", ascii_unit(field.unit));
    dataset.set_text("description", field.sentence);
    unsigned axis = 0;
    for (const std::string_view along : {field.rows, field.columns}) {
      if (!along.empty())
        dataset.attach_scale(axis++, scale(along));
    }
    written_.insert_or_assign(field.name, Written{std::move(dataset), std::string(name_without_unit(field))});
  }

  struct Written {
    hdf5::Dataset dataset;
    std::string name;
    bool scale = false;
  };
  const hdf5::Dataset& scale(std::string_view along) {
    Written& written = written_.at(along);
    if (!std::exchange(written.scale, true))
      written.dataset.make_scale(written.name);
    return written.dataset;
  }

  std::optional<hdf5::Group> own_;
  const hdf5::Group& group_;
  std::map<std::string_view, Written> written_; ///< by the name of the field
};

void put_path(const LoadPath& path, const Group& group) {
  group.put("phase", "1", path.phase);
  group.put("start_rotation", "rad", path.start_rotation_rad);
  group.put("start_torque", "N.m", path.start_torque_nm);
  group.put("start_stiffness", "N.m/rad", path.start_stiffness_nm_per_rad);
  group.put("end_rotation", "rad", path.end_rotation_rad);
  group.put("end_torque", "N.m", path.end_torque_nm);
  std::vector<double> rotation, torque, stiffness, phi, height, z;
  std::vector<int> wall_joins, wall_leaves, event_of, tooth, coast, joins, whole_tooth;
  for (std::size_t k = 0; k < path.events.size(); ++k) {
    const LoadPathEvent& event = path.events[k];
    rotation.push_back(event.rotation_rad);
    torque.push_back(event.torque_nm);
    stiffness.push_back(event.stiffness_nm_per_rad);
    wall_joins.push_back(event.wall_joins);
    wall_leaves.push_back(event.wall_leaves);
    for (const LoadPathChange& change : event.changes) {
      event_of.push_back(static_cast<int>(k));
      tooth.push_back(change.point.tooth);
      phi.push_back(change.point.phi_deg);
      coast.push_back(change.point.coast);
      height.push_back(change.point.flank_radius_mm);
      z.push_back(change.point.z_mm);
      joins.push_back(change.joins);
      whole_tooth.push_back(change.whole_tooth);
    }
  }
  const Group events(group, "events");
  events.put("rotation", "rad", rotation);
  events.put("torque", "N.m", torque);
  events.put("stiffness", "N.m/rad", stiffness);
  events.put("wall_joins", wall_joins);
  events.put("wall_leaves", wall_leaves);
  const Group changes(group, "changes");
  changes.put("event", event_of);
  changes.put("tooth", tooth);
  changes.put("phi", "deg", phi);
  changes.put("coast", coast);
  changes.put("flank_radius", "mm", height);
  changes.put("z", "mm", z);
  changes.put("joins", joins);
  changes.put("whole_tooth", whole_tooth);
  std::vector<double> at_torque, at_rotation, direct, exact_rad, exact_nm;
  for (const LoadOnPath& load : path.loads) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    at_torque.push_back(load.torque_nm);
    at_rotation.push_back(load.rotation_rad);
    direct.push_back(load.direct_difference);
    exact_rad.push_back(load.exact_minus_path_rad.value_or(none));
    exact_nm.push_back(load.exact_minus_path_nm.value_or(none));
  }
  const Group loads(group, "loads");
  loads.put("torque", "N.m", at_torque);
  loads.put("rotation", "rad", at_rotation);
  loads.put("direct_difference", "1", direct);
  loads.put("exact_minus_path_rotation", "rad", exact_rad);
  loads.put("exact_minus_path_torque", "N.m", exact_nm);
}

} // namespace

void write_result_file(const ForwardResult& result, const std::string& config,
                       const std::filesystem::path& path, const LoadPath* load_path) {
  hdf5::write_file(path, {"strainwave result", 1}, [&](const hdf5::Group& root) {
    root.put_text("config", config);
    Hdf5Writer writer(root);
    write_result(result, writer);
    if (load_path)
      put_load_path(*load_path, root);
  });
}

} // namespace strainwave
