// A NumPy archive: a ZIP file, stored without packing, of one .npy file for each array.
#include <bit>
#include <cstring>
#include <limits>

#include "output/export_common.h"
#include "output/role_name.h"
#include "output/take_poses.h"
#include "record/byte_stream.h"
#include "record/crc32.h"

namespace brickfall {
namespace {

static_assert(std::endian::native == std::endian::little);  // arrays are written as they lie in memory

void putNumber(Bytes& out, std::uint64_t value, int bytes) {
  for (int k = 0; k < bytes; k++) out.push_back(std::uint8_t(value >> (8 * k)));
}

std::string shapeText(const std::vector<std::size_t>& shape) {
  std::string out = "(";
  for (std::size_t n : shape) out += std::to_string(n) + ",";
  if (shape.size() > 1) out.pop_back();
  return out + ")";
}

// Version 1.0 of the format: a text padded so that the data begins at a multiple of 64 bytes.
Bytes npyHead(const char* type, const std::vector<std::size_t>& shape) {
  std::string text =
      std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': " + shapeText(shape) + ", }";
  while ((10 + text.size() + 1) % 64 != 0) text += ' ';
  text += '\n';
  Bytes out = {0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0};
  putNumber(out, text.size(), 2);
  out.insert(out.end(), text.begin(), text.end());
  return out;
}

// Code points of UTF-8; what is no UTF-8 becomes U+FFFD.
std::u32string codePoints(const std::string& text) {
  std::u32string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = std::uint8_t(text[i++]);
    const int more = lead < 0x80 ? 0 : lead >> 5 == 6 ? 1 : lead >> 4 == 14 ? 2 : lead >> 3 == 30 ? 3 : -1;
    char32_t code = more < 0 ? 0xFFFD : more == 0 ? lead : char32_t(lead & (0x3F >> more));
    for (int k = 0; k < more; k++) {
      if (i == text.size() || (std::uint8_t(text[i]) & 0xC0) != 0x80) {
        code = 0xFFFD;
        break;
      }
      code = code << 6 | (std::uint8_t(text[i++]) & 0x3F);
    }
    out += code > 0x10FFFF || (code >= 0xD800 && code < 0xE000) ? char32_t(0xFFFD) : code;
  }
  return out;
}

class NpzWriter {
 public:
  explicit NpzWriter(const std::string& path) : path_(path), file_(path) {}
  Status open() { return file_.open(); }

  template <class T>
  void add(const std::string& name, const char* type, const std::vector<T>& values, std::vector<std::size_t> shape) {
    Bytes content = npyHead(type, shape);
    const std::size_t head = content.size();
    content.resize(head + values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(content.data() + head, values.data(), values.size() * sizeof(T));
    store(name + ".npy", content);
  }
  // Texts of one width, as NumPy has them; an empty one has width 1.
  void addTexts(const std::string& name, const std::vector<std::string>& texts) {
    std::vector<std::u32string> codes;
    std::size_t width = 1;
    for (const std::string& text : texts) {
      codes.push_back(codePoints(text));
      width = std::max(width, codes.back().size());
    }
    std::vector<char32_t> flat;
    for (std::u32string& code : codes) {
      code.resize(width, U'\0');
      flat.insert(flat.end(), code.begin(), code.end());
    }
    add(name, ("<U" + std::to_string(width)).c_str(), flat, {texts.size()});
  }
  Status finish();

 private:
  void store(const std::string& name, const Bytes& content);

  std::string path_;
  AtomicFile file_;
  Bytes directory_;
  std::uint64_t at_ = 0;
  std::size_t entries_ = 0;
};

constexpr std::uint64_t kMostBytes = 0xfffffffe;

void NpzWriter::store(const std::string& name, const Bytes& content) {
  const auto common = [&](Bytes& out) {
    putNumber(out, 20, 2);      // version needed
    putNumber(out, 0x0800, 2);  // names are UTF-8
    putNumber(out, 0, 2);       // stored
    putNumber(out, 0, 2);       // time
    putNumber(out, 0x0021, 2);  // 1 January 1980: the same bytes on every day
    putNumber(out, crc32(content), 4);
    putNumber(out, content.size(), 4);
    putNumber(out, content.size(), 4);
    putNumber(out, name.size(), 2);
    putNumber(out, 0, 2);  // extra field
  };
  Bytes local;
  putNumber(local, 0x04034b50, 4);
  common(local);
  local.insert(local.end(), name.begin(), name.end());
  putNumber(directory_, 0x02014b50, 4);
  putNumber(directory_, 20, 2);
  common(directory_);
  putNumber(directory_, 0, 2);  // comment
  putNumber(directory_, 0, 2);  // disk
  putNumber(directory_, 0, 2);  // internal attributes
  putNumber(directory_, 0, 4);  // external ones
  putNumber(directory_, at_, 4);
  directory_.insert(directory_.end(), name.begin(), name.end());
  file_.write(local);
  file_.write(content);
  at_ += local.size() + content.size();
  entries_++;
}

Status NpzWriter::finish() {
  if (at_ + directory_.size() > kMostBytes)
    return Error{ErrorCode::limitExceeded, path_ + ": more than the 4 GiB of this archive; export every second frame"};
  Bytes end;
  putNumber(end, 0x06054b50, 4);
  putNumber(end, 0, 4);
  putNumber(end, entries_, 2);
  putNumber(end, entries_, 2);
  putNumber(end, directory_.size(), 4);
  putNumber(end, at_, 4);
  putNumber(end, 0, 2);
  file_.write(directory_);
  file_.write(end);
  return file_.commit();
}

// Frames by bodies; not a number where a body is not there.
struct Grid {
  std::vector<double> time, position;
  std::vector<float> rotation, speed, force;
};

Grid gridOf(const TakePoses& poses, std::size_t every) {
  Grid out;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t f = 0; f < poses.frames; f += every) {
    out.time.push_back(poses.times[f]);
    for (std::size_t body = 0; body < poses.bodies; body++) {
      const bool there = poses.lives[body].holds(f);
      const std::size_t at = poses.start[body] + f - poses.lives[body].birth;
      const Vec3 p = there ? poses.poses[at].position : Vec3{kNone, kNone, kNone};
      const Quat q = there ? poses.poses[at].rotation : Quat{kNone, kNone, kNone, kNone};
      out.position.insert(out.position.end(), {p.x, p.y, p.z});
      out.rotation.insert(out.rotation.end(), {float(q.x), float(q.y), float(q.z), float(q.w)});
      out.speed.push_back(there ? poses.speed[at] : float(kNone));
      out.force.push_back(there ? poses.contactForce[at] : float(kNone));
    }
  }
  return out;
}

void addBodies(const TakeReader& take, NpzWriter& npz) {
  std::vector<std::string> names, roles, materials;
  std::vector<double> masses;
  std::vector<std::int64_t> births, ends;
  std::vector<std::uint32_t> colours;
  for (const TakeBody& body : take.bodies()) {
    names.push_back(body.name);
    roles.push_back(roleName(body.role));
    materials.push_back(body.material);
    masses.push_back(body.mass);
    colours.push_back(body.colour);
  }
  for (const TakeLife& life : take.lives()) {
    births.push_back(std::int64_t(life.birth));
    ends.push_back(std::int64_t(life.end));
  }
  const std::size_t n = names.size();
  npz.addTexts("body_name", names);
  npz.addTexts("body_role", roles);
  npz.addTexts("body_material", materials);
  npz.add("body_colour", "<u4", colours, {n});
  npz.add("body_mass_kg", "<f8", masses, {n});
  npz.add("body_first_frame", "<i8", births, {n});
  npz.add("body_end_frame", "<i8", ends, {n});
}

void addEvents(const TakePoses& poses, NpzWriter& npz) {
  std::vector<std::string> types;
  std::vector<std::uint32_t> a, b;
  std::vector<double> points, times;
  std::vector<float> impulses;
  for (std::size_t k = 0; k < poses.events.size(); k++) {
    const TakeEvent& event = poses.events[k];
    types.push_back(eventName(event.type));
    times.push_back(poses.times[poses.eventFrame[k]]);
    a.push_back(event.bodyA);
    b.push_back(event.bodyB);
    points.insert(points.end(), {event.pointWorld.x, event.pointWorld.y, event.pointWorld.z});
    impulses.push_back(event.impulse);
  }
  const std::size_t n = types.size();
  npz.addTexts("event", types);
  npz.add("event_time_s", "<f8", times, {n});
  npz.add("event_body_a", "<u4", a, {n});
  npz.add("event_body_b", "<u4", b, {n});
  npz.add("event_point_m", "<f8", points, {n, 3});
  npz.add("event_impulse_n_s", "<f4", impulses, {n});
}

}  // namespace

Status exportNpz(const TakeReader& take, const std::string& stem, const ExportOptions& options,
                 const Progress& progress, std::vector<std::string>& files) {
  const std::string path = stem + ".npz";
  const Result<TakePoses> poses = readPoses(take, path, progress, 0.7);
  if (!poses) return poses.error();
  const std::size_t frames = (poses->frames + options.every - 1) / options.every, bodies = poses->bodies;
  if (double(frames) * double(bodies) * 48 > double(kMostBytes))
    return Error{ErrorCode::limitExceeded, path + ": more than the 4 GiB of this archive; export every second frame"};
  NpzWriter npz(path);
  if (Status opened = npz.open(); !opened) return opened;
  const Grid grid = gridOf(*poses, options.every);
  if (progress && !progress(0.9)) return cancelled(path);
  npz.add("time_s", "<f8", grid.time, {frames});
  npz.add("position_m", "<f8", grid.position, {frames, bodies, 3});
  npz.add("rotation_xyzw", "<f4", grid.rotation, {frames, bodies, 4});
  npz.add("speed_m_s", "<f4", grid.speed, {frames, bodies});
  npz.add("contact_force_n", "<f4", grid.force, {frames, bodies});
  addBodies(take, npz);
  addEvents(*poses, npz);
  for (const TakeColumn& column : seriesOf(take.summaryJson()))
    npz.add("series_" + column.name, "<f8", column.values, {column.values.size()});
  if (Status written = npz.finish(); !written) return written;
  files.push_back(path);
  return {};
}

}  // namespace brickfall
