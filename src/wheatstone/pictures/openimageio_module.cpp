#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "wheatstone/pictures/picture_module_internal.h"

namespace wheatstone {
namespace {

OIIO::TypeDesc type_of(NumberKind kind) {
  if (kind == bytes_kind) return OIIO::TypeDesc::UINT8;
  if (kind == words_kind) return OIIO::TypeDesc::UINT16;
  return kind == halves_kind ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
}

std::optional<PictureAttribute> attribute_of(const OIIO::ParamValue& value) {
  const OIIO::TypeDesc type = value.type();
  const auto count = static_cast<int>(type.numelements());
  if (type.basetype == OIIO::TypeDesc::STRING) {
    if (!type.is_array()) return value.get_string();
    std::vector<std::string> words;
    for (int i = 0; i < count; ++i) words.push_back(value.get_ustring_indexed(i).string());
    return words;
  }
  if (type.is_array() && type.basetype == OIIO::TypeDesc::UINT8) {
    const auto* const first = static_cast<const std::uint8_t*>(value.data());
    return std::vector<std::uint8_t>(first, first + value.datasize());
  }
  if (type.is_array() || type.aggregate != OIIO::TypeDesc::SCALAR) return std::nullopt;
  if (type == OIIO::TypeFloat) return value.get<float>();
  if (!type.is_floating_point()) return value.get_int();
  return std::nullopt;
}

StoredPicture picture_of(const OIIO::ImageSpec& spec) {
  StoredPicture picture;
  picture.width = spec.width;
  picture.height = spec.height;
  picture.depth = spec.depth;
  picture.has_deep = spec.deep;
  picture.channels = spec.nchannels;
  picture.kind = {static_cast<int>(8 * spec.format.size()), spec.format.is_floating_point()};
  picture.channel_names = spec.channelnames;
  // Of GIFs, OpenImageIO 2.4 gives the number of a channel that they do not have.
  picture.alpha_channel = spec.alpha_channel < spec.nchannels ? spec.alpha_channel : spec.channelindex("A");
  picture.left = spec.x;
  picture.top = spec.y;
  picture.full_left = spec.full_x;
  picture.full_top = spec.full_y;
  picture.full_width = spec.full_width;
  picture.full_height = spec.full_height;
  for (const OIIO::ParamValue& value : spec.extra_attribs)
    if (std::optional<PictureAttribute> attribute = attribute_of(value))
      picture.attributes.insert_or_assign(value.name().string(), std::move(*attribute));
  return picture;
}

struct PutAttribute {
  OIIO::ImageSpec& spec;
  const std::string& name;

  void operator()(int number) const { spec.attribute(name, number); }
  void operator()(float number) const { spec.attribute(name, number); }
  void operator()(const Ratio& ratio) const { spec.attribute(name, OIIO::TypeRational, &ratio); }
  void operator()(const std::string& word) const { spec.attribute(name, word); }
  void operator()(const std::vector<std::string>& words) const {
    const std::vector<OIIO::ustring> named(words.begin(), words.end());
    spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::STRING, static_cast<int>(named.size())), named.data());
  }
  void operator()(const std::vector<std::uint8_t>& bytes) const {
    spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(bytes.size())), bytes.data());
  }
};

OIIO::ImageSpec spec_of(const StoredPicture& picture) {
  OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, type_of(picture.kind));
  if (!picture.channel_names.empty()) spec.channelnames = picture.channel_names;
  if (picture.alpha_channel >= 0) spec.alpha_channel = picture.alpha_channel;
  spec.x = picture.left;
  spec.y = picture.top;
  if (picture.full_width > 0) {
    spec.full_x = picture.full_left;
    spec.full_y = picture.full_top;
    spec.full_width = picture.full_width;
    spec.full_height = picture.full_height;
  }
  for (const auto& [name, attribute] : picture.attributes) std::visit(PutAttribute{spec, name}, attribute);
  return spec;
}

/// What nobody asks for, OpenImageIO prints when the program ends.
void forget_complaints(const OIIO::ImageInput& input) {
  input.geterror();
  OIIO::geterror();
}

class Reader : public PictureReader {
 public:
  explicit Reader(std::unique_ptr<OIIO::ImageInput> input)
      : input_(std::move(input)), picture_(picture_of(input_->spec())) {}
  ~Reader() override { forget_complaints(*input_); }

  std::string format() const override { return input_->format_name(); }
  const StoredPicture& picture() const override { return picture_; }
  bool go_to(int picture) override {
    if (!input_->seek_subimage(picture, 0)) return false;
    picture_ = picture_of(input_->spec());
    return true;
  }
  bool read(std::uint8_t* to) override {
    return input_->read_image(input_->current_subimage(), 0, 0, picture_.channels, asked(OIIO::TypeDesc::UINT8), to);
  }
  bool read(int first_row, int rows, int channels, float* to) override {
    const int part = input_->current_subimage();
    const OIIO::TypeDesc type = asked(OIIO::TypeDesc::FLOAT);
    if (rows == picture_.height) return input_->read_image(part, 0, 0, channels, type, to);
    if (input_->spec().tile_width > 0) return read_of_tiles(first_row, rows, channels, to);
    const int top = picture_.top + first_row;
    return input_->read_scanlines(part, 0, top, top + rows, 0, 0, channels, type, to);
  }
  std::string complaint() override { return input_->geterror(); }

 private:
  /// Reads all tiles that the rows touch.
  bool read_of_tiles(int first_row, int rows, int channels, float* to) {
    const OIIO::ImageSpec& spec = input_->spec();
    const int tile = spec.tile_height;
    const int begin = first_row / tile * tile, end = std::min((first_row + rows + tile - 1) / tile * tile, spec.height);
    const std::size_t numbers_a_row = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(channels);
    std::vector<float> read(numbers_a_row * static_cast<std::size_t>(end - begin));
    if (!input_->read_tiles(input_->current_subimage(), 0, spec.x, spec.x + spec.width, spec.y + begin, spec.y + end,
                            spec.z, spec.z + 1, 0, channels, OIIO::TypeDesc::FLOAT, read.data()))
      return false;
    std::copy_n(read.data() + numbers_a_row * static_cast<std::size_t>(first_row - begin),
                numbers_a_row * static_cast<std::size_t>(rows), to);
    return true;
  }

  /// OpenImageIO 2.4 converts by way of 64 MB, even from a type to itself; UNKNOWN asks for the type that is stored.
  OIIO::TypeDesc asked(OIIO::TypeDesc type) const {
    const OIIO::ImageSpec& spec = input_->spec();
    return spec.format == type && spec.channelformats.empty() ? OIIO::TypeDesc(OIIO::TypeDesc::UNKNOWN) : type;
  }

  std::unique_ptr<OIIO::ImageInput> input_;
  StoredPicture picture_;
};

OIIO::ImageSpec wish_for(StoredAlpha alpha) {
  OIIO::ImageSpec wish;
  if (alpha == StoredAlpha::kept_apart) wish.attribute("oiio:UnassociatedAlpha", 1);
  return wish;
}

OpenedPicture open_file(const std::filesystem::path& path, StoredAlpha alpha) {
  const OIIO::ImageSpec wish = wish_for(alpha);
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string(), &wish);
  if (!input) return {nullptr, OIIO::geterror()};
  return {std::make_unique<Reader>(std::move(input)), {}};
}

class Writer : public PictureWriter {
 public:
  Writer(std::unique_ptr<OIIO::ImageOutput> output, std::string name, std::vector<unsigned char>* bytes)
      : output_(std::move(output)), name_(std::move(name)) {
    if (bytes == nullptr) return;
    memory_ = std::make_unique<OIIO::Filesystem::IOVecOutput>(*bytes);
    output_->set_ioproxy(memory_.get());
  }
  ~Writer() override {
    output_->geterror();
    OIIO::geterror();
  }

  bool begin(std::span<const StoredPicture> pictures) override {
    std::vector<OIIO::ImageSpec> specs;
    for (const StoredPicture& picture : pictures) specs.push_back(spec_of(picture));
    top_ = specs.front().y;
    return specs.size() == 1 ? output_->open(name_, specs.front())
                             : output_->open(name_, static_cast<int>(specs.size()), specs.data());
  }
  bool begin_next(const StoredPicture& picture) override {
    top_ = picture.top;
    return output_->open(name_, spec_of(picture), OIIO::ImageOutput::AppendSubimage);
  }
  bool write(const PixelRows& rows) override {
    const OIIO::TypeDesc type = type_of(rows.kind);
    if (rows.rows == output_->spec().height)
      return output_->write_image(type, rows.first, OIIO::AutoStride, rows.row_bytes);
    const int top = top_ + rows.first_row;
    return output_->write_scanlines(top, top + rows.rows, 0, type, rows.first, OIIO::AutoStride, rows.row_bytes);
  }
  bool end() override { return output_->close(); }
  std::string complaint() override { return output_->geterror(); }

 private:
  std::unique_ptr<OIIO::Filesystem::IOVecOutput> memory_;
  std::unique_ptr<OIIO::ImageOutput> output_;
  std::string name_;
  int top_ = 0;
};

std::unique_ptr<PictureWriter> writer(const std::string& ending, const std::filesystem::path& path,
                                      std::vector<unsigned char>* bytes) {
  const std::string name = "picture" + ending;
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
  if (!output) {
    OIIO::geterror();
    return nullptr;
  }
  return std::make_unique<Writer>(std::move(output), bytes != nullptr ? name : path.string(), bytes);
}

}  // namespace
}  // namespace wheatstone

extern "C" const wheatstone::PictureModule* wheatstone_picture_module() {
  static constexpr wheatstone::PictureModule module{wheatstone::open_file, wheatstone::writer};
  return &module;
}
