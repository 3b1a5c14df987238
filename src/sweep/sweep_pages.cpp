#include "slalom/sweep/sweep_pages.hpp"

#include <set>

#include "../io/file_set.hpp"
#include "slalom/sweep/sweep.hpp"
#include "sweep_files.hpp"

namespace slalom::sweep {

void write_sweep_report(const std::filesystem::path& folder,
                        const report::PublishedSweep& published) {
  const auto table = read_sweep(folder);
  std::set<std::int64_t> kept;
  std::error_code error;
  for (const auto& record : table.trials)
    if (std::filesystem::exists(drive_folder(folder, record.trial) / "report.html", error))
      kept.insert(record.trial);
  io::FileSet files;
  for (const auto& figure : report::sweep_figures(table))
    files.add(folder / "figures" / figure.file, figure.svg);
  files.add(folder / "index.html", report::sweep_page(table, published, kept));
  files.commit();
}

}  // namespace slalom::sweep
