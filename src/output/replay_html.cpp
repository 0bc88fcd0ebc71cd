// One page: the template with title, description, poster and motion put in their places.
#include <filesystem>
#include <fstream>

#include "output/base64.h"
#include "output/replay_meta.h"
#include "output/replay_template.h"
#include "output/replay_tracks.h"
#include "record/atomic_file.h"

namespace brickfall {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

constexpr std::size_t kMostPoster = 4 << 20;  // bytes

// Of the kinds of picture that every browser shows; empty: none of them.
std::string_view pictureType(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
  if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "image/webp";
  return {};
}

// The picture as an element of the page.
Result<std::string> posterElement(const std::string& file) {
  if (file.empty()) return std::string();
  std::ifstream in(file, std::ios::binary);
  std::string bytes(kMostPoster + 1, '\0');
  in.read(bytes.data(), std::streamsize(bytes.size()));
  bytes.resize(std::size_t(in.gcount()));
  if (!in.is_open() || in.bad()) return Error{ErrorCode::inputOutput, file + ": cannot be read"};
  const std::string_view type = pictureType(bytes);
  if (type.empty()) return Error{ErrorCode::badFormat, file + ": expected a PNG, JPEG or WebP picture"};
  if (bytes.size() > kMostPoster) return Error{ErrorCode::limitExceeded, file + ": expected at most 4 MB"};
  const std::vector<std::uint8_t> raw(bytes.begin(), bytes.end());
  return "<img id=\"poster\" alt=\"\" src=\"data:" + std::string(type) + ";base64," + base64(raw) + "\">";
}

bool isAddress(const std::string& text) { return text.starts_with("https://") || text.starts_with("http://"); }

// Where the page and the poster beside it will be found: previews take whole addresses only.
std::string addressTags(const PageWishes& wishes) {
  if (wishes.address.empty()) return {};
  const std::string page = escaped(wishes.address);
  std::string tags = "\n<meta property=\"og:url\" content=\"" + page + "\">";
  if (wishes.poster.empty()) return tags;
  const std::size_t host = wishes.address.find("//") + 2, slash = wishes.address.rfind('/');
  const std::string folder = slash < host ? wishes.address + "/" : wishes.address.substr(0, slash + 1);
  const std::string picture = escaped(folder + std::filesystem::path(wishes.poster).filename().string());
  return tags + "\n<meta property=\"og:image\" content=\"" + picture +
         "\">\n<meta name=\"twitter:card\" content=\"summary_large_image\">";
}

// Title and a line of what it is, for who shows a link to the page.
std::string preview(const TakeReader& take, const std::string& title) {
  std::size_t bricks = 0;
  for (const TakeBody& body : take.bodies()) bricks += body.role == BodyRole::brick;
  const std::size_t count = bricks > 0 ? bricks : take.bodies().size();
  const std::string line = std::to_string(count) + (bricks > 0 ? " brick" : " bod") +
                           (bricks > 0 ? (count == 1 ? "" : "s") : (count == 1 ? "y" : "ies")) +
                           ", simulated by Brickfall: orbit, scrub, click a brick for its figures.";
  return "<meta property=\"og:title\" content=\"" + title +
         "\">\n<meta property=\"og:type\" content=\"website\">\n<meta property=\"og:description\" content=\"" + line +
         "\">\n<meta name=\"description\" content=\"" + line + "\">";
}

}  // namespace

Status writeReplayHtml(const TakeReader& take, const std::string& path, const Progress& progress,
                       const PageWishes& wishes) {
  if (take.frameCount() == 0) return Error{ErrorCode::invalidArgument, path + ": the take has no frames to replay"};
  if (!wishes.address.empty() && !isAddress(wishes.address))
    return Error{ErrorCode::invalidArgument, wishes.address + ": an address of a page begins with https:// or http://"};
  const Result<std::string> poster = posterElement(wishes.poster);
  if (!poster) return poster.error();
  Result<TakePoses> poses = readPoses(take, path, progress, 0.5);
  if (!poses) return poses.error();
  double step = replayPositionStep(*poses);
  Bytes tracks = replayTracks(*poses, step);
  if (tracks.empty()) return Error{ErrorCode::limitExceeded, path + ": the take is too large to pack into a page"};
  if (progress && !progress(0.95)) return cancelled(path);

  std::string page;
  for (std::string_view piece : replayTemplate()) page += piece;
  const TakeHeader& header = take.header();
  const std::string title = escaped(header.title.empty() ? header.scene : header.title);
  const std::pair<std::string_view, std::string> places[] = {
      {kTitlePlace, title},
      {kPreviewPlace, preview(take, title) + addressTags(wishes)},
      {kPosterPlace, *poster},
      {kMetaPlace, replayMeta(take, poses->breaks, step)},
      {kDataPlace, base64(tracks)}};
  AtomicFile file(path);
  if (Status opened = file.open(); !opened) return opened;
  std::size_t from = 0;
  for (const auto& [place, text] : places) {
    std::size_t at = page.find(place, from);
    if (at == std::string::npos) return Error{ErrorCode::badFormat, "replay template lacks " + std::string(place)};
    file.write(std::string_view(page).substr(from, at - from));
    file.write(text);
    from = at + place.size();
  }
  file.write(std::string_view(page).substr(from));
  if (progress && !progress(1)) return cancelled(path);
  return file.commit();
}

}  // namespace brickfall
