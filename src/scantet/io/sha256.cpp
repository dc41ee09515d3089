// OpenSSL's EVP interface, which uses the processor's SHA instructions where there are any.
#include "scantet/io/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/regular_file.h"

namespace scantet {
namespace {

void require(int openssl_result) {
  if (openssl_result != 1) {
    throw Error(Fault::internal, "internal.sha256", "OpenSSL cannot compute SHA-256",
                "check the configuration of OpenSSL (a restricted provider?)");
  }
}

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    require(context_ != nullptr ? EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) : 0);
  }
  void add(const char* data, std::size_t size) { require(EVP_DigestUpdate(context_.get(), data, size)); }
  std::string digits() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned int size = 0;
    require(EVP_DigestFinal_ex(context_.get(), bytes.data(), &size));
    std::string text;
    for (unsigned int i = 0; i < size; ++i) {
      text += "0123456789abcdef"[bytes[i] / 16];
      text += "0123456789abcdef"[bytes[i] % 16];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context_;
};

[[noreturn]] void throw_unreadable(const std::string& path) {
  throw Error(Fault::input, "input.cannot_open", path + ": " + std::generic_category().message(errno),
              "check the name and that you may read the file");
}

}  // namespace

std::string sha256_file(const std::string& path) {
  check_regular_file(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (file == nullptr) throw_unreadable(path);
  constexpr std::size_t kBlock = std::size_t{1} << 18;
  std::vector<char> block(kBlock);
  Sha256 sha;
  for (std::size_t read = kBlock; read == kBlock;) {
    read = std::fread(block.data(), 1, kBlock, file.get());
    if (std::ferror(file.get()) != 0) throw_unreadable(path);
    sha.add(block.data(), read);
  }
  return sha.digits();
}

std::string sha256_text(std::string_view text) {
  Sha256 sha;
  sha.add(text.data(), text.size());
  return sha.digits();
}

}  // namespace scantet
