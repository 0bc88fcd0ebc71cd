// Writes a take as the run goes. Every record is handed to the operating system in one piece before write() returns, with
// no buffer of our own in between: whatever kills the process, the whole frames written so far are in the file.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "brickfall/take.h"
#include "record/body_codec.h"
#include "record/frame_codec.h"
#include "record/header_codec.h"
#include "record/take_record.h"

namespace brickfall {

struct TakeWriter::Impl {
  std::string path;
  std::vector<std::string> names;  // of all bodies that ever were there
  FrameCodec codec;
  int file = -1;
  std::uint64_t size = 0;              // bytes written and whole
  std::vector<std::uint64_t> offsets;  // of the frames
  ByteWriter changes;                  // as the index has them
  std::uint64_t changeCount = 0, lastChange = 0;
  Status state;  // the first refusal of the system; nothing is written after it
  bool finished = false;

  explicit Impl(std::string filePath) : path(std::move(filePath)) {}
  ~Impl() {
    if (file >= 0) ::close(file);
  }

  Error refused(const char* what) const {
    return {ErrorCode::inputOutput, path + ": cannot " + what + ": " + std::strerror(errno)};
  }

  Error wrong(const std::string& what) const {
    return {ErrorCode::invalidArgument, path + ": frame " + std::to_string(offsets.size()) + ": " + what};
  }

  Status check(const TakeFrame& frame, const TakeChange& change) const;
  Bytes changeRecord(const TakeChange& change);

  Status append(std::span<const std::uint8_t> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        state = refused("write");
        // Back to the last whole record. Should that fail too, the reader drops the torn one by its checksum.
        [[maybe_unused]] int cut = done > 0 ? ::ftruncate(file, off_t(size)) : 0;
        return state;
      }
      done += std::size_t(count);
    }
    size += bytes.size();
    return {};
  }
};

namespace {

// Empty: all of them are there, in ascending order, and are taken out.
std::string takeOut(const std::string& noun, const std::vector<std::uint32_t>& ends,
                    std::vector<std::uint32_t>& there) {
  for (std::size_t k = 0; k < ends.size(); k++) {
    if (k > 0 && ends[k] <= ends[k - 1]) return "the ends are not in ascending order";
    if (!std::binary_search(there.begin(), there.end(), ends[k]))
      return noun + " " + std::to_string(ends[k]) + " ends, but is not there";
  }
  std::erase_if(there, [&](std::uint32_t one) { return std::binary_search(ends.begin(), ends.end(), one); });
  return {};
}

}  // namespace

// Nothing is changed.
Status TakeWriter::Impl::check(const TakeFrame& frame, const TakeChange& change) const {
  if (!change.any()) {
    Status same = checkFrame(frame, codec.cast(), names);
    return same ? same : Status(wrong(same.error().message));
  }
  FrameCast cast = codec.cast();
  std::vector<std::string> known = names;
  if (std::string fault = takeOut("body", change.ends, cast.bodies); !fault.empty()) return wrong(fault);
  if (std::string fault = takeOut("joint", change.mortarEnds, cast.mortar); !fault.empty()) return wrong(fault);
  for (const TakeBody& body : change.births) {
    std::string fault = bodyFault(body);
    if (!fault.empty()) return wrong("body " + std::to_string(known.size()) + " \"" + body.name + "\": " + fault);
    cast.bodies.push_back(std::uint32_t(cast.knownBodies++));
    known.push_back(body.name);
  }
  for (const TakeMortar& mortar : change.mortar) {
    if (std::string fault = mortarFault(mortar, cast.knownBodies); !fault.empty()) return wrong(fault);
    cast.mortar.push_back(std::uint32_t(cast.knownMortar++));
  }
  Status fine = checkFrame(frame, cast, known);
  return fine ? fine : Status(wrong(fine.error().message));
}

Bytes TakeWriter::Impl::changeRecord(const TakeChange& change) {
  if (!change.any()) return {};
  codec.change(change.ends, change.births.size(), change.mortarEnds, change.mortar.size());
  for (const TakeBody& body : change.births) names.push_back(body.name);
  Bytes record = makeRecord(RecordType::life, encodeChange(change));
  changes.varint(offsets.size() - lastChange);
  changes.varint(record.size());
  lastChange = offsets.size();
  changeCount++;
  return record;
}

TakeWriter::TakeWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TakeWriter::TakeWriter(TakeWriter&&) noexcept = default;
TakeWriter& TakeWriter::operator=(TakeWriter&&) noexcept = default;
TakeWriter::~TakeWriter() = default;

Result<TakeWriter> TakeWriter::create(const std::string& path, const TakeHeader& header) {
  if (Status checked = checkHeader(header); !checked) {
    return Error{checked.error().code, path + ": take header: " + checked.error().message};
  }
  auto impl = std::make_unique<Impl>(path);
  impl->file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (impl->file < 0) return impl->refused("create");

  ByteWriter start;
  start.append(kTakeMagic);
  start.u32(kTakeVersion);
  start.append(makeRecord(RecordType::header, encodeHeader(header)));
  if (Status written = impl->append(start.bytes()); !written) return written.error();
  return TakeWriter(std::move(impl));
}

Status TakeWriter::write(const TakeFrame& frame, const TakeChange& change) {
  if (!impl_->state) return impl_->state;
  if (impl_->finished) return Error{ErrorCode::wrongState, impl_->path + ": the take is finished"};
  if (Status checked = impl_->check(frame, change); !checked) return checked;
  // Both records in one piece: a change without its frame would be of no use.
  Bytes bytes = impl_->changeRecord(change);
  std::uint64_t offset = impl_->size + bytes.size();
  bool key = impl_->offsets.size() % kTakeGroupFrames == 0;
  Bytes record = makeRecord(RecordType::frame, impl_->codec.encode(frame, key));
  bytes.insert(bytes.end(), record.begin(), record.end());
  Status written = impl_->append(bytes);
  if (written) impl_->offsets.push_back(offset);
  return written;
}

Status TakeWriter::finish(const std::string& summaryJson) {
  if (!impl_->state) return impl_->state;
  if (impl_->finished) return Error{ErrorCode::wrongState, impl_->path + ": the take is already finished"};
  ByteWriter index;
  index.varint(impl_->offsets.size());
  std::uint64_t last = 0;
  for (std::uint64_t offset : impl_->offsets) {
    index.varint(offset - last);
    last = offset;
  }
  index.varint(impl_->changeCount);
  index.append(impl_->changes.bytes());
  index.text(summaryJson);
  ByteWriter end;
  end.append(makeRecord(RecordType::index, index.bytes()));
  end.u64(impl_->size);
  end.append(kTakeEndMagic);
  if (Status written = impl_->append(end.bytes()); !written) return written;
  impl_->finished = true;
  // On the disk before anybody gives it a name that says it is whole. Pipes and the like cannot, and need not.
  if (::fsync(impl_->file) != 0 && errno != EINVAL) return impl_->state = impl_->refused("write");
  int file = impl_->file;
  impl_->file = -1;
  if (::close(file) != 0) return impl_->state = impl_->refused("close");
  return {};
}

}  // namespace brickfall
