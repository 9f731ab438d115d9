// Questions and answers as NumPy arrays.
#include "python/src/columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "formats/input_error.hpp"
#include "python/src/lock.hpp"

namespace contact::python {
namespace {

std::string path_of(std::string field) {
  std::replace(field.begin(), field.end(), '.', '/');
  return field;
}

template <class Value>
std::vector<py::ssize_t> with_rows(std::size_t rows, const Value& value) {
  std::vector shape{static_cast<py::ssize_t>(rows)};
  for (const std::uint64_t n : extents_of(value)) shape.push_back(static_cast<py::ssize_t>(n));
  return shape;
}

class MemoryArray final : public formats::ArrayReader {
 public:
  MemoryArray(formats::ArrayType type, py::array array)
      : ArrayReader(std::move(type), static_cast<std::uint64_t>(array.shape(0))), array_(std::move(array)) {}
  ~MemoryArray() override {
    const WithLock python_lock;
    array_ = py::array();
  }

  void read(std::uint64_t first, std::uint64_t count, std::vector<char>& bytes) override {
    const auto* begin = static_cast<const char*>(array_.data()) + first * type().row_size();
    bytes.assign(begin, begin + count * type().row_size());
  }

 private:
  py::array array_;  // by rows
};

class MemoryArrays final : public formats::ArraysFile {
 public:
  MemoryArrays(std::string what, const py::dict& arrays, std::string header)
      : where_{std::move(what), 0}, header_(std::move(header)) {
    for (const auto& [key, value] : arrays) {
      const auto name = py::cast<std::string>(key);
      // By rows, and in this processor's order of bytes.
      auto array = py::cast<py::array>(py::module_::import("numpy").attr("ascontiguousarray")(value));
      if (py::cast<py::array>(value).ndim() == 0)
        throw formats::InputError(where_, "/" + name, "expected rows, got one value");
      arrays_.emplace(name, std::move(array));
    }
  }

  nlohmann::json header() override { return nlohmann::json::parse(header_); }
  std::optional<std::string> header_text() override { return header_; }
  std::set<std::string> names() override {
    std::set<std::string> names;
    for (const auto& [name, array] : arrays_) names.insert(name);
    return names;
  }
  nlohmann::json labels(const std::string& /*name*/) override { return {}; }

  std::unique_ptr<formats::ArrayReader> open(const std::string& name) override {
    const py::array& array = arrays_.at(name);
    formats::ArrayType type;
    type.size = static_cast<std::size_t>(array.itemsize());
    for (py::ssize_t i = 1; i < array.ndim(); ++i) type.row.push_back(static_cast<std::uint64_t>(array.shape(i)));
    using Kind = formats::ArrayType::Kind;
    const char kind = array.dtype().kind();
    const bool is_native = py::cast<bool>(array.dtype().attr("isnative"));
    if (kind == 'f' && is_native && (type.size == sizeof(double) || type.size == sizeof(float)))
      type.kind = Kind::real;
    else if (kind == 'b' || (kind == 'u' && type.size == 1))
      type.kind = Kind::byte;
    else if (kind == 'S')
      type.kind = Kind::text;
    else
      throw formats::InputError(where_, "/" + name,
                                fmt::format("has values of NumPy's kind {}; known here: float64, float32, bool, uint8 "
                                            "and bytes",
                                            py::cast<std::string>(py::str(array.dtype()))));
    return std::make_unique<MemoryArray>(std::move(type), array);
  }

 private:
  formats::Location where_;
  std::string header_;
  std::map<std::string, py::array> arrays_;
};

}  // namespace

void widen(Query& query, const Query& other) {
  std::vector<std::size_t> sizes;
  for_each_value(other, [&]<class Value>(const Value& value) {
    if constexpr (AnyNumberOfVectors<Value>) sizes.push_back(value.size());
  });
  auto size = sizes.begin();
  for_each_value(query, [&]<class Value>(Value& value) {
    if constexpr (AnyNumberOfVectors<Value>) value.resize(std::max(value.size(), *size++), Vector3::Zero());
  });
}

Query widest_query(Pair pair) {
  Query query = zero_query(pair);
  for_each_value(query, []<class Value>(Value& value) {
    if constexpr (AnyNumberOfVectors<Value>) value.resize(kMostVertices, Vector3::Zero());
  });
  return query;
}

void RowCount::look() {
  constexpr std::size_t kRowsBetween = 16;  // the slowest row takes milliseconds
  next_look_ = done_ + kRowsBetween;
  tool::throw_if_interrupted();
  if (!bar_ && std::chrono::steady_clock::now() - begun_ > std::chrono::seconds(1)) bar_.emplace(label_, total_);
  if (bar_) bar_->add(done_ - std::exchange(shown_, done_));
}

QuestionArrays::QuestionArrays(Pair pair, const py::list& columns, const py::array& alarm, const py::array& contact)
    : pair_(pair) {
  for (const auto& column : columns) kept_.push_back(py::cast<py::array>(column));
  kept_.push_back(alarm);
  kept_.push_back(contact);
  const Query widest = widest_query(pair);
  std::size_t i = 0;
  for_each_field(widest, [&](const std::string& field, const auto& value, FieldKind) {
    if (i >= kept_.size()) throw std::invalid_argument(fmt::format("{}: missing", field));
    const py::array& array = kept_[i++];
    const bool is_single = py::isinstance<py::array_t<float>>(array);
    if ((!is_single && !py::isinstance<py::array_t<double>>(array)) || array.ndim() == 0)
      throw std::invalid_argument(fmt::format("{}: expected rows of float64 or float32", field));
    if (i == 1) size_ = static_cast<std::size_t>(array.shape(0));
    auto shape = with_rows(size_, value);
    const bool any_number = AnyNumberOfVectors<decltype(value)>;
    if (any_number && array.ndim() == 3) shape[1] = std::clamp<py::ssize_t>(array.shape(1), 1, shape[1]);
    if (!std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim()))
      throw std::invalid_argument(fmt::format("{}: expected a shape of ({}), got ({})", field, fmt::join(shape, ", "),
                                              fmt::join(array.shape(), array.shape() + array.ndim(), ", ")));
    Column column{
        static_cast<const char*>(array.data()), {}, any_number ? static_cast<std::size_t>(shape[1]) : 0, is_single};
    std::copy_n(array.strides(), array.ndim(), column.strides.begin());
    columns_.push_back(column);
  });
  if (i != kept_.size()) throw std::invalid_argument("more columns than the pair has fields");
}

QuestionColumns::QuestionColumns(const Query& widest, Scalar scalar, std::size_t size) : scalar_(scalar) {
  const py::array ids(py::dtype(fmt::format("S{}", golden::kIdLength)), std::vector<std::size_t>{size});
  ids_ = static_cast<char*>(const_cast<void*>(ids.data()));
  arrays_["id"] = ids;
  for_each_field(widest, [&](const std::string& field, const auto& value, FieldKind) {
    const py::dtype type = scalar == Scalar::binary32 ? py::dtype::of<float>() : py::dtype::of<double>();
    const py::array array(type, with_rows(size, value));
    std::size_t across = 0;
    for_each_number_in(value, [&](double) { ++across; });
    columns_.push_back({static_cast<char*>(const_cast<void*>(array.data())), across});
    arrays_[py::str(path_of(field))] = array;
  });
}

void QuestionColumns::set(std::size_t row, const Query& query) {
  const Column* column = columns_.data();
  for_each_value(query, [&](const auto& value) {
    std::size_t at = row * column->across;
    const auto put = [&](double x) {
      if (scalar_ == Scalar::binary32)
        reinterpret_cast<float*>(column->begin)[at++] = static_cast<float>(x);
      else
        reinterpret_cast<double*>(column->begin)[at++] = x;
    };
    for_each_number_in(value, put);
    while (at < (row + 1) * column->across) put(std::numeric_limits<double>::quiet_NaN());
    ++column;
  });
}

py::tuple QuestionColumns::as_columns() const {
  py::list columns;
  for (const auto& [name, array] : arrays_)
    if (py::cast<std::string>(name) != "id") columns.append(array);
  py::object contact = columns.attr("pop")();
  py::object alarm = columns.attr("pop")();
  return py::make_tuple(columns, alarm, contact);
}

std::unique_ptr<formats::ArraysFile> arrays_in_memory(std::string what, const py::dict& arrays, std::string header) {
  return std::make_unique<MemoryArrays>(std::move(what), arrays, std::move(header));
}

}  // namespace contact::python
