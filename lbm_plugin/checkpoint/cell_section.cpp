// SPDX-License-Identifier: MPL-2.0
#include "checkpoint/cell_section.h"

#include <array>
#include <bit>
#include <numeric>
#include <stdexcept>

namespace npfem::flow {
namespace {

constexpr std::size_t start_words = 1 + 3 + 9;  // type, centre, rotation
constexpr std::size_t tag_words = 4;            // type, status, iterations, residual
constexpr std::size_t words_at_once = std::size_t{1} << 20;

Word word_of(double value) {
  return std::bit_cast<Word>(value);
}
Word word_of(int value) {
  return static_cast<Word>(static_cast<std::int64_t>(value));
}
double number_of(Word word) {
  return std::bit_cast<double>(word);
}
int integer_of(Word word) {
  return static_cast<int>(static_cast<std::int64_t>(word));
}

/// Where the words of each cell begin; one more than there are cells. One that has left has none.
std::vector<std::int64_t> layout_of(const CellPopulation& population, const std::vector<CellStart>& all,
                                    const std::vector<Departure>& departures) {
  std::vector<std::int64_t> begin{0};
  for (const CellStart& cell : all) {
    begin.push_back(static_cast<std::int64_t>(tag_words + population.pack_length(cell.type)));
  }
  for (const Departure& departure : departures) begin.at(static_cast<std::size_t>(departure.id) + 1) = 0;
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  return begin;
}

/// For each cell its place among those that have not left; -1 for one that has.
std::vector<std::int64_t> places_of(const std::vector<CellStart>& all, const std::vector<Departure>& departures) {
  std::vector<std::int64_t> places(all.size(), 0);
  for (const Departure& departure : departures) places.at(static_cast<std::size_t>(departure.id)) = -1;
  std::int64_t next = 0;
  for (std::int64_t& place : places) {
    if (place == 0) place = next++;
  }
  return places;
}

std::vector<Word> record_of(const CellPopulation& population, const CellPopulation::Cell& cell) {
  const CellOutcome& outcome = population.outcome(cell);
  std::vector<Word> words{word_of(cell.type), word_of(outcome.status), word_of(outcome.iterations),
                          word_of(outcome.residual)};
  for (const double number : population.pack(cell)) words.push_back(word_of(number));
  return words;
}

void add_cell(CellPopulation& population, int id, const std::vector<Word>& words) {
  const CellOutcome outcome{integer_of(words[1]), integer_of(words[2]), number_of(words[3])};
  std::vector<double> state;
  for (std::size_t n = tag_words; n < words.size(); ++n) state.push_back(number_of(words[n]));
  population.add_packed(integer_of(words[0]), id, outcome, state);
}

/// This rank's share, before each cell goes to its owner.
void read_share(CellPopulation& population, const std::vector<CellStart>& all, const std::vector<Departure>& departures,
                CheckpointFile& file, const Communicator& communicator) {
  const std::vector<std::int64_t> begin = layout_of(population, all, departures);
  if (file.words("cells") != begin.back()) {
    throw std::runtime_error(file.path().string() + ": its cells are not of the types of the scene");
  }
  const std::int64_t count = std::ssize(all);
  std::vector<Word> words;
  for (std::int64_t id = count * communicator.rank() / communicator.size();
       id < count * (communicator.rank() + 1) / communicator.size(); ++id) {
    const auto i = static_cast<std::size_t>(id);
    words.resize(static_cast<std::size_t>(begin[i + 1] - begin[i]));
    if (words.empty()) continue;
    file.read("cells", begin[i], words);
    if (integer_of(words[0]) != all[i].type) {
      throw std::runtime_error(file.path().string() + ": cell " + std::to_string(id) + " changes its type");
    }
    add_cell(population, static_cast<int>(id), words);
  }
}

}  // namespace

void save_placed(const std::vector<CellStart>& cells, Communicator& communicator, CheckpointWriter& file) {
  std::vector<Word> words;
  if (communicator.rank() == 0) {
    for (const CellStart& cell : cells) {
      words.push_back(word_of(cell.type));
      for (const double x : cell.centre) words.push_back(word_of(x));
      for (const double x : cell.rotation) words.push_back(word_of(x));
    }
  }
  const CheckpointWriter::Piece piece{0, words};
  file.begin_section("placed");
  file.write(std::span(&piece, 1));
  file.end_section();
}

std::vector<CellStart> load_placed(CheckpointFile& file) {
  std::vector<Word> words(static_cast<std::size_t>(file.words("placed")));
  file.read("placed", 0, words);
  std::vector<CellStart> cells;
  for (std::size_t n = 0; n + start_words <= words.size(); n += start_words) {
    CellStart& cell = cells.emplace_back();
    cell.type = integer_of(words[n]);
    for (std::size_t i = 0; i < 3; ++i) cell.centre[i] = number_of(words[n + 1 + i]);
    for (std::size_t i = 0; i < 9; ++i) cell.rotation[i] = number_of(words[n + 4 + i]);
  }
  return cells;
}

void save_centres(const CellPopulation& population, const std::vector<CellStart>& all,
                  const std::vector<Departure>& departures, CheckpointWriter& file) {
  const std::vector<std::int64_t> places = places_of(all, departures);
  std::vector<double> xyz;
  population.read("position", xyz);
  std::vector<std::array<Word, 3>> words;
  words.reserve(population.cells().size());
  std::vector<CheckpointWriter::Piece> pieces;
  for (const CellPopulation::Cell& cell : population.cells()) {
    const std::size_t vertices = population.vertices_of(cell.type);
    Vec3 centre{};
    for (std::size_t v = cell.first_vertex; v < cell.first_vertex + vertices; ++v) {
      centre = add(centre, vector_at(xyz, v));
    }
    centre = scale(1.0 / static_cast<double>(vertices), centre);
    words.push_back({word_of(centre[0]), word_of(centre[1]), word_of(centre[2])});
    pieces.push_back({3 * places[static_cast<std::size_t>(cell.id)], words.back()});
  }
  file.begin_section("centres");
  file.write(pieces);
  file.end_section();
}

std::vector<CellStart> load_present(const std::vector<CellStart>& all, const std::vector<Departure>& departures,
                                    CheckpointFile& file) {
  if (file.words("centres") != 3 * (std::ssize(all) - std::ssize(departures))) {
    throw std::runtime_error(file.path().string() + ": it does not say where its cells are");
  }
  std::vector<Word> words(static_cast<std::size_t>(file.words("centres")));
  file.read("centres", 0, words);
  const std::vector<std::int64_t> places = places_of(all, departures);
  std::vector<CellStart> present;
  for (std::size_t id = 0; id < all.size(); ++id) {
    if (places[id] < 0) continue;
    const Word* const at = &words[3 * static_cast<std::size_t>(places[id])];
    present.push_back({all[id].type, {number_of(at[0]), number_of(at[1]), number_of(at[2])}, identity_rotation});
  }
  return present;
}

void save_cells(const CellPopulation& population, const std::vector<CellStart>& all,
                const std::vector<Departure>& departures, CheckpointWriter& file, Communicator& communicator) {
  const std::vector<std::int64_t> begin = layout_of(population, all, departures);
  const auto own = population.cells();
  file.begin_section("cells");
  for (std::size_t next = 0; communicator.any(next < own.size());) {
    std::vector<std::vector<Word>> records;
    std::vector<CheckpointWriter::Piece> pieces;
    for (std::size_t words = 0; next < own.size() && words < words_at_once; ++next) {
      records.push_back(record_of(population, own[next]));
      pieces.push_back({begin[static_cast<std::size_t>(own[next].id)], records.back()});
      words += records.back().size();
    }
    file.write(pieces);
  }
  file.end_section();
}

void load_cells(CellPopulation& population, const std::vector<CellStart>& all, const std::vector<Departure>& departures,
                CheckpointFile& file, Communicator& communicator) {
  std::string failure;
  try {
    read_share(population, all, departures, file, communicator);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  communicator.agree(failure);
  population.migrate();
}

}  // namespace npfem::flow
