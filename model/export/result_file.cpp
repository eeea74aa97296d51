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
