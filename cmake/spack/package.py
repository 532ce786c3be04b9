# The recipe of mesoslip for spack: put this folder as packages/mesoslip into a repository of spack's, set git to where the project is, then
#   spack install mesoslip
from spack.package import CMakePackage, depends_on, generator, license, variant, version


class Mesoslip(CMakePackage):
    """From the microstructure of a composite to its sliding contact and back: homogenization, explicit dynamics with friction, localization."""

    git = ""  # where the project is
    license("LGPL-2.1-or-later")

    version("main", branch="main")

    variant("tests", default=False, description="Build the tests")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("dealii@9.4:9.7+mpi+trilinos+hdf5+arpack+metis+muparser")
    depends_on("trilinos+ml+epetra+aztec+amesos")
    depends_on("arpack-ng+mpi")
    depends_on("gmsh@4.8:")
    depends_on("suite-sparse")
    depends_on("muparser")
    depends_on("eigen@3.4:")
    depends_on("boost@1.74:+program_options+serialization")
    depends_on("nlohmann-json")
    depends_on("libpng")
    depends_on("libtiff")
    depends_on("xxhash")
    depends_on("mpi")
    depends_on("googletest", when="+tests")
    depends_on("python", type="run")
    for module in ("numpy", "scipy", "h5py", "matplotlib"):
        depends_on(f"py-{module}", type="run")

    generator("ninja")

    def cmake_args(self):
        return [self.define("MESOSLIP_UNITY", True), self.define_from_variant("MESOSLIP_BUILD_TESTS", "tests")]
