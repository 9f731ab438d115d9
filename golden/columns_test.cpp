// Columns in HDF5 hold what JSON lines hold, to the byte, and nothing damaged is taken for it.
#include "golden/columns.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "formats/hdf5.hpp"
#include "golden/families.hpp"
#include "golden/query_id.hpp"
#include "golden/right_case.hpp"

namespace contact::golden {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void put(const fs::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

class Columns : public testing::Test {
 protected:
  Columns() : folder_(fs::temp_directory_path() / testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::create_directories(folder_);
  }
  ~Columns() override { fs::remove_all(folder_); }

  static void convert(const fs::path& from, const fs::path& to) {
    DatasetReader reader(from, is_made);
    const auto writer = create_dataset(to, reader.header());
    while (const auto c = reader.next()) writer->write(*c, reader.text());
    writer->commit();
  }

  fs::path make(std::uint64_t count, Pair pair = Pair::sphere_sphere, std::string_view name = "generic") const {
    DatasetHeader header;
    header.pair = pair;
    header.family = name;
    header.count = count;
    fs::path path = folder_ / "made.h5";
    const auto writer = create_dataset(path, header);
    const Family& family = *find_family(pair, name);
    for (std::uint64_t i = 0; i < count; ++i) {
      const Case c = make_case(generate_query(pair, family, header.scalar, header.seed, i), header.scalar);
      writer->write(c, to_line(c));
    }
    writer->commit();
    return path;
  }

  /// The lines of all cases, or the message of the refusal.
  static std::string read(const fs::path& path) {
    try {
      std::string lines;
      DatasetReader reader(path, is_made);
      while (reader.next()) lines += reader.text() + "\n";
      return lines;
    } catch (const formats::InputError& error) {
      return std::string("refused ") + error.what();
    }
  }

  fs::path folder_;
};

TEST_F(Columns, GiveBackEveryCommittedFileToTheByte) {
  for (const fs::path& path : dataset_files({fs::path(CONTACT_SOURCE_DIR) / "golden"})) {
    convert(path, folder_ / "x.h5");
    convert(folder_ / "x.h5", folder_ / "x.jsonl");
    EXPECT_TRUE(content(path) == content(folder_ / "x.jsonl")) << path;
  }
}

TEST_F(Columns, AreTheSameBytesInEveryRun) {
  const std::string first = content(make(100));
  EXPECT_TRUE(first == content(make(100)));
}

TEST_F(Columns, HoldBlocksThatAreFullAndOneThatIsNot) {
  for (const std::uint64_t count : {0U, 1U, 4096U, 4097U}) {
    const fs::path path = make(count, Pair::cube_cube, "nested");
    convert(path, folder_ / "x.jsonl");
    const std::string lines = content(folder_ / "x.jsonl");
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), count + 1);
    EXPECT_TRUE(lines.ends_with(read(path)));
  }
}

TEST_F(Columns, CanBeSkippedAsLinesCan) {
  const fs::path columns = make(5000);
  convert(columns, folder_ / "x.jsonl");
  for (const std::uint64_t n : {0U, 1U, 4095U, 4096U, 4999U, 5000U, 7000U}) {
    DatasetReader of_columns(columns, is_made);
    DatasetReader of_lines(folder_ / "x.jsonl", is_made);
    of_columns.skip(n);
    of_lines.skip(n);
    while (const auto c = of_lines.next()) {
      const auto d = of_columns.next();
      ASSERT_TRUE(d) << n;
      EXPECT_EQ(of_lines.text(), of_columns.text());
      EXPECT_EQ(of_lines.where().line, of_columns.where().line + 1);
    }
    EXPECT_FALSE(of_columns.next());
  }
}

TEST_F(Columns, HaveRoomForEveryExactNumberAndNotMuchMore) {
  for (const Scalar scalar : kScalars) {
    const bool wide = scalar == Scalar::binary64;
    const double most = wide ? std::numeric_limits<double>::max() : std::numeric_limits<float>::max();
    const double least = wide ? std::numeric_limits<double>::denorm_min() : std::numeric_limits<float>::denorm_min();
    const Vector3 far(most, most, most);
    const Query spheres{Pair::sphere_sphere, Balls{{far, most}, {{-most, -most, least}, least}}, {most, 0}};
    const oracle::Witness w = make_case(spheres, scalar).exact;
    const Query cubes{Pair::cube_cube, Boxes{{far, far}, {-far, {-most, -most, least}}}, {0, 0}};
    const std::string gap = make_case(cubes, scalar).exact.gap[2];
    for (const auto& [text, power] : {std::pair(w.distance2, 2), std::pair(w.reach, 1), std::pair(gap, 1)}) {
      EXPECT_LE(text.size(), longest_exact(power, scalar));
      EXPECT_GT(text.size() + 6, longest_exact(power, scalar)) << text.size();
    }
  }
}

TEST_F(Columns, AreRefusedWhereverAByteIsAnotherOrMeanTheSame) {
  // Every byte of the file is under some checksum, or means nothing.
  for (const auto& [pair, family] : {std::pair(Pair::sphere_sphere, "touching"), std::pair(Pair::cube_cube, "flat"),
                                     std::pair(Pair::cube_cube, "invalid")}) {
    const std::string good = content(make(8, pair, family));
    const std::string lines = read(folder_ / "made.h5");
    ASSERT_FALSE(lines.starts_with("refused"));
    std::size_t refused = 0;
    for (std::size_t at = 0; at < good.size(); at += 1 + at / 512) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ 1 << at % 8);
      put(folder_ / "bad.h5", bad);
      const std::string found = read(folder_ / "bad.h5");
      if (found.starts_with("refused"))
        ++refused;
      else
        EXPECT_EQ(found, lines) << at;
    }
    EXPECT_GT(refused, 200);
  }
}

TEST_F(Columns, HoldAsManyVerticesAsAHullHas) {
  DatasetHeader header;
  header.pair = Pair::hull_plane;
  header.family = "own";
  header.count = kMostVertices;
  std::vector<Query> queries(kMostVertices, zero_query(header.pair));
  for (std::size_t k = 0; k < queries.size(); ++k) {
    auto number = static_cast<double>(k);
    auto& vertices = std::get<Hull>(std::get<Convexes>(queries[k].shapes).a.shape).vertices;
    vertices.assign(k + 1, Vector3(number, 0, 0));
    for (Vector3& v : vertices) v.y() = ++number;
    std::get<Plane>(std::get<Convexes>(queries[k].shapes).b.shape).normal = Vector3(0, 1, 0);
  }
  for (const char* const name : {"made.h5", "made.npz", "made.jsonl"}) {
    const auto writer = create_dataset(folder_ / name, header);
    for (const Query& query : queries) {
      const Case c = make_case(query, header.scalar);
      writer->write(c, to_line(c));
    }
    writer->commit();
  }
  const std::string lines = read(folder_ / "made.jsonl");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), kMostVertices);
  EXPECT_EQ(read(folder_ / "made.h5"), lines);
  EXPECT_EQ(read(folder_ / "made.npz"), lines);
  // 98 kB of vertices, half of them padding.
  EXPECT_LT(fs::file_size(folder_ / "made.npz"), 40000);
}

TEST_F(Columns, AreNotWrittenWhereTheLastVertexOfAHullIsNone) {
  DatasetHeader header;
  header.pair = Pair::hull_plane;
  header.family = kInvalidFamily;
  header.count = 1;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Query query = zero_query(header.pair);
  auto& vertices = std::get<Hull>(std::get<Convexes>(query.shapes).a.shape).vertices;
  const auto written = [&](std::vector<Vector3> all) {
    vertices = std::move(all);
    const auto writer = create_dataset(folder_ / "made.h5", header);
    const Case c = make_case(query, header.scalar);
    try {
      writer->write(c, to_line(c));
      writer->commit();
    } catch (const formats::InputError& error) {
      return std::string(error.what());
    }
    return read(folder_ / "made.h5") == to_line(c) + "\n" ? std::string("as it was") : read(folder_ / "made.h5");
  };
  const Vector3 none(kNaN, kNaN, kNaN);
  EXPECT_EQ(written({none, {0, 0, 0}}), "as it was");
  EXPECT_EQ(written({{0, 0, 0}, {kNaN, kNaN, 0}}), "as it was");
  EXPECT_EQ(written({{0, 0, 0}, {0, kNaN, kNaN}}), "as it was");
  EXPECT_NE(written({{0, 0, 0}, none}).find("row 0: /a/vertices: expected from 1 to 64 points, the last not all NaN"),
            std::string::npos);
}

TEST_F(Columns, AreRefusedWhereATextIsNoExactNumber) {
  DatasetHeader header;
  header.family = "generic";
  header.count = 1;
  Case c =
      make_case(generate_query(header.pair, *find_family(header.pair, "generic"), header.scalar, 1, 0), header.scalar);
  c.exact.reach = "0x2p0";
  const fs::path path = folder_ / "made.h5";
  const auto writer = create_dataset(path, header);
  writer->write(c, to_line(c));
  writer->commit();
  const std::string found = read(path);
  EXPECT_NE(found.find("exact.reach: expected an exact number such as \"-0x1abdp-12\", got \"0x2p0\""),
            std::string::npos)
      << found;
}

// As many as a row's number has bits: none of these is without a name.
TEST_F(Columns, NameUpTo32Flags) {
  const fs::path path = make(8, Pair::sphere_sphere, "touching");
  const std::string lines = read(path);
  ASSERT_FALSE(lines.starts_with("refused"));
  const auto read_with_names = [&](std::size_t count) {
    {
      const formats::hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
      const formats::hdf5::Handle flags(H5Oopen(file, "flags", H5P_DEFAULT), H5Oclose);
      nlohmann::json names = formats::hdf5::read_attribute(flags, "names");
      while (names.size() < count) names.push_back("other" + std::to_string(names.size()));
      names.erase(names.begin() + static_cast<std::ptrdiff_t>(count), names.end());
      H5Adelete(flags, "names");
      formats::hdf5::write_attribute(flags, "names", names);
      // The digest of the columns has the names; that of the lines, which is left, does not.
      if (H5Aexists(file, "columns_sha256") > 0) H5Adelete(file, "columns_sha256");
    }
    return read(path);
  };
  EXPECT_EQ(read_with_names(32), lines);
  EXPECT_NE(read_with_names(33).find("/flags: more than 32 names"), std::string::npos);
  EXPECT_NE(read_with_names(1).find("/flags: a bit without a name, in 0x"), std::string::npos);
}

TEST_F(Columns, AreRefusedWhereTheyAreCut) {
  const std::string good = content(make(300));
  for (std::size_t size = 0; size < good.size(); size += 997) {
    put(folder_ / "bad.h5", good.substr(0, size));
    EXPECT_TRUE(read(folder_ / "bad.h5").starts_with("refused ")) << size;
  }
}

TEST_F(Columns, NameTheRowAndTheColumnOfADamagedChunk) {
  const fs::path path = make(5000);
  haddr_t address = 0;
  hsize_t size = 0;
  {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t column = H5Dopen2(file, "/exact/distance2", H5P_DEFAULT);
    const hsize_t second = 4096;
    ASSERT_GE(H5Dget_chunk_info_by_coord(column, &second, nullptr, &address, &size), 0);
    H5Dclose(column);
    H5Fclose(file);
  }
  std::string bytes = content(path);
  bytes[address + size / 2] ^= 1;
  put(path, bytes);
  EXPECT_EQ(read(path), "refused " + path.string() +
                            ": row 4096: /exact/distance2: cannot read: data error detected by "
                            "Fletcher32 checksum");
}

}  // namespace
}  // namespace contact::golden
