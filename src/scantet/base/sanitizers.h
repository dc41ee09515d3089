// Whether this is a build for AddressSanitizer or ThreadSanitizer. GCC says so by macros, Clang by features.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SCANTET_IS_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SCANTET_IS_SANITIZED
#endif
#endif
