#include "../io/file_set.hpp"
#include "reproduction.hpp"

namespace slalom::paper {

void write_reproduction(const std::filesystem::path& folder,
                        const std::vector<ReproducedDrive>& drives, const PaperData& paper,
                        const std::vector<ConceptCase>& cases) {
  io::FileSet files;
  files.add(folder / "index.html", reproduction_page(drives, paper, cases));
  for (const auto& figure : reproduction_figures(drives, paper, cases))
    files.add(folder / "figures" / figure.file, figure.svg);
  files.commit();
}

}  // namespace slalom::paper
