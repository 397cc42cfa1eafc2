classdef sparse_local_constraints < handle
%SPARSE_LOCAL_CONSTRAINTS  Rows held at given values, on top of a factor that stays as it is.
%
%   P = F.constraints(I)      of a factor F (sparse_local): x is held in rows I
%   x = P.solve(b, values)    A * x = b in the other rows; numel(I) x k values for b of n x k
%   x = P.solve(b, values, Q) the same in the rows of a plan Q of F; b has the rows of that plan
%   P.add(I), P.release(K)    more pins; without those of number K. The others keep their order
%   P.refactor()              after F has changed
%
%   For a definite A, x minimizes x' * A * x / 2 - b' * x under these equalities.
%
%   See also sparse_local.

    properties (SetAccess = private)
        factor;    % the factor, a sparse_local
        count = 0; % pins
    end
    properties (SetAccess = private, Hidden = true, Transient = true)
        id = 0; % of the object in sparse_local_mex; 0: none
    end

    methods
        function this = sparse_local_constraints(F, list)
            this.id = sparse_local_mex('constraints', F.id);
            this.factor = F;
            this.add(list);
        end

        function delete(this)
            if this.id > 0, sparse_local_mex('free', this.id); end
            this.id = 0;
        end

        function add(this, list)
            % P.add(I): holds more rows.
            list = this.factor.rows(list);
            sparse_local_mex('constraints_add', this.id, list);
            this.count = this.count + numel(list);
        end

        function release(this, numbers)
            % P.release(K): releases the pins of these numbers; the others keep their order.
            sparse_local_mex('constraints_release', this.id, double(numbers(:)));
            this.count = this.count - numel(numbers);
        end

        function refactor(this)
            % P.refactor(): takes the present numbers of the factor.
            sparse_local_mex('constraints_refactor', this.id);
        end

        function x = solve(this, b, values, plan)
            % x = P.solve(b, values): solves with the pins held at values.
            q = 0;
            if nargin > 3, q = plan.id; end
            x = sparse_local_mex('constraints_solve', this.factor.id, this.id, full(double(b)), ...
                                 full(double(values)), this.count, q);
        end

        function disp(this)
            fprintf('  %d pins on%s', this.count, evalc('disp(this.factor)'));
        end
    end
end
