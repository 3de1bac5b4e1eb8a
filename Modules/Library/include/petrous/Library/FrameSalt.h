#pragma once

#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::library
{

class Library;

/// `frameOfReference` (as ImagePart, not salted) as the cases of this library store it: a hash with
/// the library's salt, so that nobody can test a hospital's UIDs against it. Throws LibraryError if
/// the salt cannot be read, or created where there is none yet (not while the library is locked by
/// the caller).
std::string saltedFrame(const Library& library, const std::string& frameOfReference);

/// The same of many, and which salt it is: the salt is read once, by the first call. Thread-safe.
scene::IdentitySalt frameSalter(const Library& library);

/// Whether images of the case have hashes with another salt than `salt`: the library's was lost and
/// another one drawn since.
bool hasLostSalt(const scene::Case& value, const scene::IdentitySalt& salt);

/// Changes the salted hashes of the images' frames of reference and patients, exclusive or with
/// what only this library knows and another CT changes. So they leave in an archive: this library
/// gets them back by the same call, and to anyone else two archives of a patient have nothing in
/// common by them. Within a case equal ones stay equal. Throws as saltedFrame.
void sealIdentity(const Library& library, scene::Case& value);

/// Of a case that comes from another library: forgets the images' frames of reference and patients
/// where they are salted, since they can be compared with nothing here. Hashes without a salt can,
/// and stay. Returns a sentence for each MR that is not registered and was known to be acquired in
/// the CT's position.
std::vector<std::string> forgetForeignIdentity(scene::Case& value);

} // namespace petrous::library
